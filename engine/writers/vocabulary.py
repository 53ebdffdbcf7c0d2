"""Every IRI that maps in RDF use; ``ontology/map.ttl`` defines the ``sl:`` ones.

The standard vocabularies: GeoSPARQL 1.1 for geometry, SOSA for observations, PROV-O for lineage,
DCMI terms for identifiers and parts.
"""

from __future__ import annotations

from symboslam.reasoning.vocabulary import DOCUMENTS, SL

GEO = "http://www.opengis.net/ont/geosparql#"
SOSA = "http://www.w3.org/ns/sosa/"
PROV = "http://www.w3.org/ns/prov#"
DCTERMS = "http://purl.org/dc/terms/"
RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
OWL = "http://www.w3.org/2002/07/owl#"
SKOS = "http://www.w3.org/2004/02/skos/core#"
XSD = "http://www.w3.org/2001/XMLSchema#"

NAMESPACES = {
    "sl": SL,
    "geo": GEO,
    "sosa": SOSA,
    "prov": PROV,
    "dcterms": DCTERMS,
    "rdf": RDF,
    "rdfs": RDFS,
    "owl": OWL,
    "skos": SKOS,
    "xsd": XSD,
}

CRS84 = "http://www.opengis.net/def/crs/OGC/1.3/CRS84"
LOCAL_METRES = DOCUMENTS + "crs/local-metres"
"""Metres east and north of a map's own origin; without it a WKT literal would mean degrees."""
MAPS = DOCUMENTS + "map/"
"""Where the IRIs of maps without a base of their own lie."""
SOFTWARE = DOCUMENTS + "software/"
