"""P28: symmetric properties whose ends differ."""

CLASSES = ":A a owl:Class . :B a owl:Class . :C a owl:Class . "
P = ":p a owl:ObjectProperty, owl:SymmetricProperty ; "

POSITIVE = {
    "two classes": (f"{P} rdfs:domain :A ; rdfs:range :B . {CLASSES}", [("p",)]),
    "one of two": (f"{P} rdfs:domain :A, :B ; rdfs:range :B . {CLASSES}", [("p",)]),
    "declared by the characteristic": (
        f":p a owl:SymmetricProperty ; rdfs:domain :A ; rdfs:range :B . {CLASSES}", [("p",)]),
}  # fmt: skip
NEGATIVE = {
    "the same": f"{P} rdfs:domain :A ; rdfs:range :A . {CLASSES}",
    "no range": f"{P} rdfs:domain :A . {CLASSES}",
    "no characteristic": f":p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :B . {CLASSES}",
    "equivalent over a third": f"{P} rdfs:domain :A ; rdfs:range :B . {CLASSES} "
    ":A owl:equivalentClass :C . :B owl:equivalentClass :C .",
    "one or more, and some": f"{P} rdfs:domain [ a owl:Restriction ; owl:onProperty :p ; "
    "owl:minCardinality 1 ] ; rdfs:range [ a owl:Restriction ; owl:onProperty :p ; "
    f"owl:someValuesFrom owl:Thing ] . {CLASSES}",
    "several, and their intersection": f"{P} rdfs:domain :A, :B ; "
    f"rdfs:range [ a owl:Class ; owl:intersectionOf (:A :B) ] . {CLASSES}",
}
STRICT = {
    "two classes, by OOPS!": (f"{P} rdfs:domain :A ; rdfs:range :B . {CLASSES}", [("p",)]),
    "equivalent classes": (
        f"{P} rdfs:domain :A ; rdfs:range :B . {CLASSES} :B owl:equivalentClass :A .", []),
    "intersections count as unlike": (
        f"{P} rdfs:domain [ a owl:Class ; owl:intersectionOf (:A :B) ] ; "
        f"rdfs:range [ a owl:Class ; owl:intersectionOf (:A :B) ] . {CLASSES}", [("p",)]),
    "no range, by OOPS!": (f"{P} rdfs:domain :A . {CLASSES}", []),
}  # fmt: skip
