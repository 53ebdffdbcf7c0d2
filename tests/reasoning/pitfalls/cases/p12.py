"""P12: properties of the same name."""

_OTHER = "<https://example.org/p#hasPart>"
POSITIVE = {
    "case and marks": (
        ":hasPart a owl:ObjectProperty . :has-part a owl:ObjectProperty .",
        [("has-part", "hasPart")],
    ),
    "three in one finding": (
        ":day a owl:DatatypeProperty . :Day a owl:DatatypeProperty . :DAY a owl:DatatypeProperty .",
        [("DAY", "Day", "day")],
    ),
    "two namespaces": (
        f":hasPart a owl:ObjectProperty . {_OTHER} a owl:ObjectProperty .",
        [("hasPart", "hasPart")],
    ),
    "inverse of something else": (
        ":ab a owl:ObjectProperty ; owl:inverseOf :c . :Ab a owl:ObjectProperty .",
        [("Ab", "ab")],
    ),
    "both, and the third is related to each": (
        ":ab a owl:ObjectProperty . :Ab a owl:ObjectProperty . "
        ":AB a owl:ObjectProperty ; owl:inverseOf :ab ; owl:propertyDisjointWith :Ab .",
        [("Ab", "ab")],
    ),
    "equivalent to something else": (
        ":ab a owl:ObjectProperty ; owl:equivalentProperty :c . :Ab a owl:ObjectProperty .",
        [("Ab", "ab")],
    ),
}
NEGATIVE = {
    "equivalent": (
        ":ab a owl:ObjectProperty ; owl:equivalentProperty :Ab . :Ab a owl:ObjectProperty ."
    ),
    "equivalent by way of another": (
        ":ab a owl:ObjectProperty ; owl:equivalentProperty :c . "
        ":Ab a owl:ObjectProperty . :c owl:equivalentProperty :Ab ."
    ),
    "one above the other": (
        ":ab a owl:ObjectProperty ; rdfs:subPropertyOf :c . "
        ":c a owl:ObjectProperty ; rdfs:subPropertyOf :Ab . :Ab a owl:ObjectProperty ."
    ),
    "inverse": ":ab a owl:ObjectProperty ; owl:inverseOf :Ab . :Ab a owl:ObjectProperty .",
    "disjoint": (
        ":ab a owl:ObjectProperty . :Ab owl:propertyDisjointWith :ab ; a owl:ObjectProperty ."
    ),
    "all disjoint, by way of one above": (
        ":ab a owl:DatatypeProperty . :Ab a owl:DatatypeProperty ; rdfs:subPropertyOf :c . "
        "[] a owl:AllDisjointProperties ; owl:members (:ab :c) ."
    ),
    "of different kinds": ":ab a owl:ObjectProperty . :Ab a owl:DatatypeProperty .",
    "deprecated": ":ab a owl:ObjectProperty . :Ab a owl:ObjectProperty ; owl:deprecated true .",
    "one digit differs": ":has1 a owl:ObjectProperty . :has2 a owl:ObjectProperty .",
}
STRICT = {
    "OOPS! skips what has an equivalent": (
        ":ab a owl:ObjectProperty ; owl:equivalentProperty :c . :Ab a owl:ObjectProperty .",
        [],
    ),
    "OOPS! reports them": (
        ":ab a owl:ObjectProperty . :Ab a owl:ObjectProperty ; owl:deprecated true .",
        [("Ab", "ab")],
    ),
    "OOPS! skips subjects of equivalence, not all objects": (
        ":x a owl:ObjectProperty ; owl:equivalentProperty :ab . "
        ":ab a owl:ObjectProperty . :Ab a owl:ObjectProperty . :AB a owl:DatatypeProperty .",
        [("Ab", "ab")],
    ),
}
