"""P05: wrong inverses."""

CLASSES = ":A a owl:Class . :B a owl:Class . :C a owl:Class . "
P = ":p a owl:ObjectProperty ; owl:inverseOf :q ; "
Q = ":q a owl:ObjectProperty ; "

POSITIVE = {
    "a domain that is no range": (
        f"{P} rdfs:domain :A . {Q} rdfs:range :B . {CLASSES}", [("p", "q")]),
    "a range that is no domain": (
        f"{P} rdfs:range :A . {Q} rdfs:domain :B . {CLASSES}", [("p", "q")]),
    "both, stated both ways": (
        f"{P} rdfs:domain :A ; rdfs:range :A . "
        f"{Q} rdfs:domain :B ; rdfs:range :B ; owl:inverseOf :p . {CLASSES}", [("p", "q")]),
    "one of two domains": (
        f"{P} rdfs:domain :A, :B . {Q} rdfs:range :A . {CLASSES}", [("p", "q")]),
    "of itself": (
        f":p a owl:ObjectProperty ; owl:inverseOf :p ; rdfs:domain :A ; rdfs:range :B . {CLASSES}",
        [("p",)]),
    "equivalent to the inverse": (
        f":p a owl:ObjectProperty ; owl:equivalentProperty [ owl:inverseOf :q ] ; "
        f"rdfs:domain :A . {Q} rdfs:range :B . {CLASSES}", [("p", "q")]),
}  # fmt: skip
NEGATIVE = {
    "they fit": f"{P} rdfs:domain :A ; rdfs:range :B . "
    f"{Q} rdfs:domain :B ; rdfs:range :A . {CLASSES}",
    "equivalent classes": f"{P} rdfs:domain :A . {Q} rdfs:range :B . {CLASSES} "
    ":A owl:equivalentClass :C . :B owl:equivalentClass :C .",
    "a union in another order": f"{P} rdfs:domain [ a owl:Class ; owl:unionOf (:A :B) ] . "
    f"{Q} rdfs:range [ a owl:Class ; owl:unionOf (:B :A) ] . {CLASSES}",
    "several domains, and their intersection": f"{P} rdfs:domain :A, :B . "
    f"{Q} rdfs:range [ a owl:Class ; owl:intersectionOf (:B :A) ] . {CLASSES}",
    "one or more, and some": f"{P} rdfs:domain [ a owl:Restriction ; owl:onProperty :r ; "
    f"owl:minCardinality 1 ] . {Q} rdfs:range [ a owl:Restriction ; owl:onProperty :r ; "
    f"owl:someValuesFrom owl:Thing ] . {CLASSES} :r a owl:ObjectProperty .",
    "equivalent to an inverse that fits": ":p a owl:ObjectProperty ; rdfs:domain :A ; "
    f"owl:equivalentProperty [ owl:inverseOf :q ] . {Q} rdfs:range :A . {CLASSES}",
    "nothing to compare": f"{P} rdfs:domain :A . {Q} rdfs:domain :B . {CLASSES}",
    "an inverse as an expression": f":p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :B ; "
    f"owl:inverseOf [ owl:inverseOf :p ] . {CLASSES}",
}
STRICT = {
    "equivalent classes count as unlike": (
        f"{P} rdfs:domain :A . {Q} rdfs:range :B . {CLASSES} :A owl:equivalentClass :B .",
        [("p", "q")]),
    "intersections count as unlike": (
        f"{P} rdfs:domain [ a owl:Class ; owl:intersectionOf (:A :B) ] . "
        f"{Q} rdfs:range [ a owl:Class ; owl:intersectionOf (:A :B) ] . {CLASSES}",
        [("p", "q")]),
    "unions in another order are alike": (
        f"{P} rdfs:domain [ a owl:Class ; owl:unionOf (:A :B) ] . "
        f"{Q} rdfs:range [ a owl:Class ; owl:unionOf (:B :A) ] . {CLASSES}", []),
    "equivalent to the inverse, by OOPS!": (
        f":p a owl:ObjectProperty ; owl:equivalentProperty [ owl:inverseOf :q ] ; "
        f"rdfs:domain :A . {Q} rdfs:range :B . {CLASSES}", []),
    "the first of two": (
        f"{P} rdfs:domain :A ; owl:inverseOf :r . {Q} rdfs:range :B . "
        f":r a owl:ObjectProperty ; rdfs:range :C . {CLASSES}", [("p", "q")]),
    "stated both ways is two findings": (
        f"{P} rdfs:domain :A . {Q} rdfs:range :B ; owl:inverseOf :p . {CLASSES}",
        [("p", "q"), ("q", "p")]),
}  # fmt: skip
