"""P41: nothing says under which licence the ontology is."""

_O = "<https://example.org/o> "

POSITIVE = {
    "none": ("", [()]),
    "empty": (_O + 'dcterms:license "" , "  " .', [()]),
    "of a class": (":A a owl:Class ; dcterms:license <https://example.org/l> .", [()]),
    "of one of two": (
        _O + "dcterms:license <https://example.org/l> . <https://example.org/p> a owl:Ontology .",
        [()],
    ),
}
NEGATIVE = {
    "dcterms:license": _O + "dcterms:license <https://example.org/l> .",
    "dcterms:rights": _O + 'dcterms:rights "CC0" .',
    "dc:rights": _O + '<http://purl.org/dc/elements/1.1/rights> "CC0" .',
    "dc:license": _O + '<http://purl.org/dc/elements/1.1/license> "CC0" .',
    "cc:license": _O + "<http://creativecommons.org/ns#license> <https://example.org/l> .",
    "schema:license": _O + "<http://schema.org/license> <https://example.org/l> .",
    "schema:license, https": _O + "<https://schema.org/license> <https://example.org/l> .",
    "xhv:license": _O + "<http://www.w3.org/1999/xhtml/vocab#license> <https://example.org/l> .",
    "doap:license": _O + "<http://usefulinc.com/ns/doap#license> <https://example.org/l> .",
    "described": _O + 'dcterms:license [ rdfs:label "Ours" ] .',
}
