"""P38: a file declares no ontology; test_documents.py has such files."""

POSITIVE: dict[str, tuple[str, list[tuple[str, ...]]]] = {}
NEGATIVE = {
    "with a full stop": "",
    "two of them": "<https://example.org/b> a owl:Ontology .",
}
STRICT = {
    "with a full stop, by OOPS!": ("", [()]),
    "with a semicolon, by OOPS!": ('<https://example.org/b> a owl:Ontology ; rdfs:label "b" .', []),
}
