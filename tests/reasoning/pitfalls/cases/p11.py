"""P11: properties without a domain or a range."""

_BOTH = " ; rdfs:domain owl:Thing ; rdfs:range owl:Thing . "
_SUB = ":p a owl:ObjectProperty ; rdfs:subPropertyOf :q . :q a owl:ObjectProperty" + _BOTH

POSITIVE = {
    "neither": (":p a owl:ObjectProperty .", [("p",)]),
    "no range": (":p a owl:DatatypeProperty ; rdfs:domain owl:Thing .", [("p",)]),
    "no domain": (":p a owl:DatatypeProperty ; rdfs:range xsd:string .", [("p",)]),
    "a super-property does not inherit": (
        ":p a owl:ObjectProperty . :q a owl:ObjectProperty ; rdfs:subPropertyOf :p" + _BOTH,
        [("p",)],
    ),
    "the inverse has the same side only": (
        ":p a owl:ObjectProperty ; rdfs:domain owl:Thing ; owl:inverseOf :q . "
        ":q a owl:ObjectProperty ; rdfs:range owl:Thing .",
        [("p",), ("q",)],
    ),
    "below the top property": (
        ":p a owl:ObjectProperty ; rdfs:subPropertyOf owl:topObjectProperty .",
        [("p",)],
    ),
    "without inheritance": (_SUB, [("p",)]),
    "declared as both kinds": (":p a owl:ObjectProperty , owl:DatatypeProperty .", [("p",)]),
}
NEGATIVE = {
    "both": ":p a owl:ObjectProperty" + _BOTH,
    "of a super-property": _SUB,
    "two steps above": ":o a owl:ObjectProperty ; rdfs:subPropertyOf :p . " + _SUB,
    "in a circle": ":q rdfs:subPropertyOf :p . " + _SUB,
    "of an equivalent property": ":p a owl:ObjectProperty . :q owl:equivalentProperty :p ; "
    "a owl:ObjectProperty" + _BOTH,
    "of the inverse": ":p a owl:ObjectProperty ; owl:inverseOf :q . :q a owl:ObjectProperty"
    + _BOTH,
    "one side from each": ":p a owl:ObjectProperty ; rdfs:domain owl:Thing ; owl:inverseOf :q . "
    ":q a owl:ObjectProperty ; rdfs:domain owl:Thing .",
    "of the inverse without a name": ":p a owl:ObjectProperty ; "
    "rdfs:subPropertyOf [ owl:inverseOf :q ] . :q a owl:ObjectProperty" + _BOTH,
    "symmetric": ":p a owl:ObjectProperty , owl:SymmetricProperty ; rdfs:domain owl:Thing .",
    "an annotation property": ":p a owl:AnnotationProperty .",
    "the top properties": "owl:topObjectProperty a owl:ObjectProperty . "
    "owl:topDataProperty a owl:DatatypeProperty .",
    "deprecated": ":p a owl:ObjectProperty ; owl:deprecated true .",
}
STRICT = {
    "of a super-property, by OOPS!": (_SUB, [("p",)]),
    "both, by OOPS!": (":p a owl:ObjectProperty" + _BOTH, []),
    "deprecated, by OOPS!": (":p a owl:DatatypeProperty ; owl:deprecated true .", [("p",)]),
}
OPTIONS = {"without inheritance": {"inherit": False}}
