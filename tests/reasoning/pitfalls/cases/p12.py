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
