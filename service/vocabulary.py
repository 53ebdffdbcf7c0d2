"""Every IRI and media type that the service names; no other module spells one out.

Plain strings, so that the worker processes start without loading anything else.
"""

from __future__ import annotations

from symboslam.reasoning.vocabulary import DOCUMENTS, OWL_NAMESPACE, RDF_NAMESPACE, SL

GRAPHS = DOCUMENTS + "graph/"
ONTOLOGY_GRAPH = GRAPHS + "ontology"
INFERENCES_GRAPH = GRAPHS + "inferences"
PROBLEMS = DOCUMENTS + "problems#"

RDFS = "http://www.w3.org/2000/01/rdf-schema#"
SD = "http://www.w3.org/ns/sparql-service-description#"
FORMATS = "http://www.w3.org/ns/formats/"

PREFIXES = {
    "sl": SL,
    "rdf": RDF_NAMESPACE,
    "rdfs": RDFS,
    "owl": OWL_NAMESPACE,
    "xsd": "http://www.w3.org/2001/XMLSchema#",
    "skos": "http://www.w3.org/2004/02/skos/core#",
    "dcterms": "http://purl.org/dc/terms/",
    "prov": "http://www.w3.org/ns/prov#",
    "sosa": "http://www.w3.org/ns/sosa/",
    "geo": "http://www.opengis.net/ont/geosparql#",
    "sd": SD,
}
"""Prefixes of what is written as Turtle or TriG."""
QUERY_PREFIXES = {
    **PREFIXES,
    "geof": "http://www.opengis.net/def/function/geosparql/",
    "uom": "http://www.opengis.net/def/uom/OGC/1.0/",
    "graph": GRAPHS,
}
"""Prefixes that the query page knows."""

# Media type -> name of the format in pyoxigraph. The first of each table is the default.
SOLUTIONS = {
    "application/sparql-results+json": "JSON",
    "application/sparql-results+xml": "XML",
    "text/csv": "CSV",
    "text/tab-separated-values": "TSV",
    "application/json": "JSON",
    "application/xml": "XML",
}
"""Results of SELECT and ASK."""
TRIPLES = {
    "text/turtle": "TURTLE",
    "application/n-triples": "N_TRIPLES",
    "application/rdf+xml": "RDF_XML",
    "application/ld+json": "JSON_LD",
    "application/n-quads": "N_QUADS",
    "application/trig": "TRIG",
    "application/json": "JSON_LD",
    "application/xml": "RDF_XML",
}
"""Graphs: what CONSTRUCT and DESCRIBE give, and whole graphs."""
UPLOADS = {
    "text/turtle": "TURTLE",
    "application/n-triples": "N_TRIPLES",
    "application/rdf+xml": "RDF_XML",
    "application/ld+json": "JSON_LD",
}
"""Graphs that are sent to us."""
SPARQL_QUERY = "application/sparql-query"
SPARQL_UPDATE = "application/sparql-update"
FORM = "application/x-www-form-urlencoded"
MULTIPART = "multipart/form-data"
PROBLEM_JSON = "application/problem+json"
TURTLE = "text/turtle"
N_TRIPLES = "application/n-triples"
JSON = "application/json"
OCTETS = "application/octet-stream"
GEOJSON = "application/geo+json"
NDJSON = "application/x-ndjson"
FILES = {
    "geojson": (GEOJSON, JSON),
    "csv": ("text/csv",),
    "osm": ("application/xml", "text/xml", "application/x-protobuf", "application/x-bzip2"),
}
"""Formats of landmark files -> what they may be called when they are sent."""
ANY_FILE = (OCTETS, "application/gzip")
"""What a file of each format may be called; so may one that is called nothing."""

RESULT_FORMATS = {
    "JSON": "SPARQL_Results_JSON",
    "XML": "SPARQL_Results_XML",
    "CSV": "SPARQL_Results_CSV",
    "TSV": "SPARQL_Results_TSV",
    "TURTLE": "Turtle",
    "N_TRIPLES": "N-Triples",
    "RDF_XML": "RDF_XML",
    "JSON_LD": "JSON-LD",
    "N_QUADS": "N-Quads",
    "TRIG": "TriG",
}
"""Name in pyoxigraph -> name in W3C's list of unique IRIs for formats (below ``FORMATS``)."""
