"""P36: the ontology's IRI names a file format."""

_A = " a owl:Ontology ."

POSITIVE = {
    "owl": ("<https://example.org/a.owl>" + _A, [()]),
    "ttl and a hash": ("<https://example.org/a.ttl#>" + _A, [()]),
    "rdfxml, in capitals": ("<https://example.org/a.RDFXML>" + _A, [()]),
    "two": ("<https://example.org/a.n3>" + _A + "<https://example.org/b.jsonld>" + _A, [()]),
}
NEGATIVE = {
    "none": "",
    "inside of a name": "<https://example.org/my.owls>"
    + _A
    + "<https://example.org/x.owl.d/a>"
    + _A,
    "a version": "<https://example.org/a/1.0>" + _A,
    "the host": "<https://example.owl>" + _A + "<https://example.owl/>" + _A,
    "a class": "<https://example.org/a.owl> a owl:Class .",
    "the place of the file": "<>" + _A,
}
