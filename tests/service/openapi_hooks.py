"""What schemathesis cannot know: valid texts of our formats, and media types that are plain text.

Loaded by the test, or with ``SCHEMATHESIS_HOOKS=tests.service.openapi_hooks``.
"""

from itertools import chain
from typing import Any

import schemathesis
from hypothesis import strategies as st

from symboslam.service.vocabulary import ANY_FILE, FILES, NDJSON, SPARQL_QUERY, SPARQL_UPDATE

QUERIES = (
    "ASK {}",
    "SELECT * { ?s ?p ?o } LIMIT 3",
    "CONSTRUCT { ?s ?p ?o } WHERE { ?s ?p ?o } LIMIT 2",
    "DESCRIBE <urn:s>",
    "SELECT (COUNT(*) AS ?n) { GRAPH ?g { ?s ?p ?o } } GROUP BY ?g",
)
UPDATES = (
    "INSERT DATA { GRAPH <urn:g> { <urn:s> <urn:p> 1 } }",
    "DELETE WHERE { GRAPH <urn:g> { <urn:s> <urn:p> ?o } }",
    "CLEAR SILENT GRAPH <urn:g>",
)
TEXTS = (SPARQL_QUERY, SPARQL_UPDATE, NDJSON, "application/n-triples", "application/rdf+xml")
FILES_SENT = {*ANY_FILE, *chain(*FILES.values())} - {"application/octet-stream"}

schemathesis.openapi.format("sparql-query", st.sampled_from(QUERIES))
schemathesis.openapi.format("sparql-update", st.sampled_from(UPDATES))


@schemathesis.serializer(*TEXTS, *sorted(kind for kind in FILES_SENT if "json" not in kind))
def plain_text(_: Any, value: Any) -> bytes:
    """Bodies that are text; and what is none, so that it is refused."""
    return value if isinstance(value, bytes) else str(value).encode("utf-8", "surrogatepass")
