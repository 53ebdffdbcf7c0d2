"""P27: wrong equivalent properties."""

CLASSES = ":A a owl:Class . :B a owl:Class . :C a owl:Class . "
P = ":p a owl:ObjectProperty ; owl:equivalentProperty :q ; "
Q = ":q a owl:ObjectProperty ; "
D = ":d a owl:DatatypeProperty ; owl:equivalentProperty :e ; rdfs:domain :A ; rdfs:range "
E = ":e a owl:DatatypeProperty ; rdfs:domain :A ; rdfs:range "

POSITIVE = {
    "domains": (f"{P} rdfs:domain :A . {Q} rdfs:domain :B . {CLASSES}", [("p", "q")]),
    "ranges": (f"{P} rdfs:range :A . {Q} rdfs:range :B . {CLASSES}", [("p", "q")]),
    "both, stated both ways": (
        f"{P} rdfs:domain :A ; rdfs:range :A . {Q} owl:equivalentProperty :p ; rdfs:domain :B ; "
        f"rdfs:range :B . {CLASSES}", [("p", "q")]),
    "datatypes, of one domain": (f"{D} xsd:int . {E} xsd:string . {CLASSES}", [("d", "e")]),
    "over a third, stated of it": (
        f":m a owl:ObjectProperty ; owl:equivalentProperty :p, :q . "
        f":p a owl:ObjectProperty ; rdfs:domain :A . {Q} rdfs:domain :B . {CLASSES}",
        [("p", "q")]),
    "over a third, in a chain": (
        f":p a owl:ObjectProperty ; owl:equivalentProperty :m ; rdfs:domain :A . "
        f":m a owl:ObjectProperty ; owl:equivalentProperty :q . {Q} rdfs:domain :B . {CLASSES}",
        [("p", "q")]),
    "one of four": (
        f"{P} rdfs:domain :A . {Q} owl:equivalentProperty :r, :s . "
        ":r a owl:ObjectProperty ; rdfs:domain :B . :s a owl:ObjectProperty ; rdfs:domain :B . "
        f"{CLASSES}", [("p", "r")]),
    "one pair for both ends": (
        f"{P} rdfs:domain :A . {Q} owl:equivalentProperty :r ; rdfs:domain :A ; rdfs:range :A . "
        f":r a owl:ObjectProperty ; rdfs:domain :B ; rdfs:range :B . {CLASSES}",
        [("q", "r")]),
}  # fmt: skip
NEGATIVE = {
    "the same": f"{P} rdfs:domain :A ; rdfs:range :B . {Q} rdfs:domain :A ; rdfs:range :B . "
    f"{CLASSES}",
    "one is not stated": f"{P} rdfs:domain :A . {Q} rdfs:range :B . {CLASSES}",
    "equivalent over a third": f"{P} rdfs:domain :A . {Q} rdfs:domain :B . {CLASSES} "
    ":A owl:equivalentClass :C . :C owl:equivalentClass :B .",
    "the same datatypes": f"{D} xsd:int . {E} xsd:int . {CLASSES}",
    "both said to be everything": ":p a owl:ObjectProperty ; rdfs:domain :A ; "
    f"owl:equivalentProperty owl:topObjectProperty . {Q} rdfs:domain :B ; "
    f"owl:equivalentProperty owl:topObjectProperty . {CLASSES}",
    "to itself": f":p a owl:ObjectProperty ; owl:equivalentProperty :p ; rdfs:domain :A . "
    f"{CLASSES}",
    "to an expression": f":p a owl:ObjectProperty ; rdfs:domain :A ; "
    f"owl:equivalentProperty [ owl:inverseOf :q ] . {Q} rdfs:domain :B . {CLASSES}",
}
STRICT = {
    "domains, by OOPS!": (f"{P} rdfs:domain :A . {Q} rdfs:domain :B . {CLASSES}", [("p", "q")]),
    "over a third, by OOPS!": (
        f":m a owl:ObjectProperty ; owl:equivalentProperty :p, :q . "
        f":p a owl:ObjectProperty ; rdfs:domain :A . {Q} rdfs:domain :B . {CLASSES}", []),
    "datatypes of one domain pass": (f"{D} xsd:int . {E} xsd:string . {CLASSES}", []),
    "equivalent over a third counts": (
        f"{P} rdfs:domain :A . {Q} rdfs:domain :B . {CLASSES} "
        ":A owl:equivalentClass :C . :C owl:equivalentClass :B .", [("p", "q")]),
    "equivalent classes pass": (
        f"{P} rdfs:range :A . {Q} rdfs:range :B . {CLASSES} :B owl:equivalentClass :A .", []),
    "of two kinds": (f"{P} rdfs:domain :A . :q a owl:DatatypeProperty ; rdfs:domain :B .", []),
}  # fmt: skip
