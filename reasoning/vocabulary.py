"""Every IRI that the reasoning code names; no other module spells one out.

Plain strings, so that loading a cached result needs no RDF library. Terms of RDF, RDFS, OWL and
SKOS itself come from ``rdflib.namespace`` where a graph is at hand.
"""

from __future__ import annotations

# Terms of SymboSLAM.
SL = "https://w3id.org/symboslam#"
PLACE = SL + "Place"
ENVIRONMENT = SL + "Environment"
FEATURE = SL + "Feature"
STATIC_FEATURE = SL + "StaticFeature"
DYNAMIC_FEATURE = SL + "DynamicFeature"
INDICATES = SL + "indicates"
PART_OF = SL + "partOf"
STRENGTH = SL + "strength"
DETECTOR_LABEL = SL + "detectorLabel"
OSM_TAG = SL + "osmTag"
COLOUR = SL + "colour"
PLAN_ZONE = SL + "planZone"
ENVIRONMENT_GROUP = SL + "environmentGroup"
ABSENCE_FEATURE = SL + "absenceFeature"
DEFAULT_SCHEME = SL + "defaultScheme"
SITE_RADIUS = SL + "siteRadius"
BANDWIDTH = SL + "bandwidth"
UPSTREAM_LABEL = SL + "upstreamLabel"
IN_UPSTREAM_DATA_ONLY = SL + "inUpstreamDataOnly"
ACCEPTED_PITFALL = SL + "acceptedPitfall"

# Ontology documents: DOCUMENTS + "core" is what an ontology of one's own imports.
DOCUMENTS = "https://w3id.org/symboslam/"

# Terms of others.
DERIVED_FROM = "http://www.w3.org/ns/prov#wasDerivedFrom"
OWL_NAMESPACE = "http://www.w3.org/2002/07/owl#"
RDF_NAMESPACE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
THING = OWL_NAMESPACE + "Thing"
NOTHING = OWL_NAMESPACE + "Nothing"


def local_name(iri: str) -> str:
    """The part of an IRI after its last ``#``, or else after its last ``/``.

    >>> local_name("https://w3id.org/symboslam#House")
    'House'
    """
    return iri.rsplit("#", 1)[-1] if "#" in iri else iri.rstrip("/").rsplit("/", 1)[-1]
