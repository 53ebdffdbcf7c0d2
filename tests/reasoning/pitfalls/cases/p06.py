"""P06: cycles of classes."""

POSITIVE = {
    "two classes": (
        ":A a owl:Class ; rdfs:subClassOf :B . :B a owl:Class ; rdfs:subClassOf :A .",
        [("A", "B")]),
    "three, under a chain": (
        ":A a owl:Class ; rdfs:subClassOf :B . :B a owl:Class ; rdfs:subClassOf :C . "
        ":C a owl:Class ; rdfs:subClassOf :A . :D a owl:Class ; rdfs:subClassOf :A, :E . "
        ":E a owl:Class .", [("A", "B", "C")]),
    "two cycles": (
        ":A rdfs:subClassOf :B . :B rdfs:subClassOf :A, :C . :C rdfs:subClassOf :D . "
        ":D rdfs:subClassOf :C . :A a owl:Class .", [("A", "B"), ("C", "D")]),
    "cycles that share a class": (
        ":A a owl:Class ; rdfs:subClassOf :B, :C . :B rdfs:subClassOf :A . "
        ":C rdfs:subClassOf :A .", [("A", "B", "C")]),
}  # fmt: skip
NEGATIVE = {
    "a diamond": ":A a owl:Class ; rdfs:subClassOf :B, :C . :B rdfs:subClassOf :D . "
    ":C rdfs:subClassOf :D .",
    "below itself": ":A a owl:Class ; rdfs:subClassOf :A .",
    "equivalent": ":A a owl:Class ; owl:equivalentClass :B . :B a owl:Class ; "
    "owl:equivalentClass :A ; rdfs:subClassOf :A .",
    "through an expression": ":A a owl:Class ; rdfs:subClassOf [ a owl:Class ; "
    "owl:unionOf (:B :C) ] . :B rdfs:subClassOf :A .",
    "a literal": ':A a owl:Class ; rdfs:subClassOf "A" .',
}
STRICT = {
    "two classes, by OOPS!": (
        ":A a owl:Class ; rdfs:subClassOf :B . :B a owl:Class ; rdfs:subClassOf :A .",
        [("A", "B")]),
    "cycles that share a class, by OOPS!": (
        ":A a owl:Class ; rdfs:subClassOf :B . :B a owl:Class ; rdfs:subClassOf :A . "
        ":C a owl:Class ; rdfs:subClassOf :D . :D a owl:Class ; rdfs:subClassOf :C .",
        [("A", "B"), ("C", "D")]),
    "a flat hierarchy": (":A a owl:Class ; rdfs:subClassOf :B . :B a owl:Class .", []),
}  # fmt: skip
