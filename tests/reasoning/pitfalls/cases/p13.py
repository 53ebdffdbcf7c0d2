"""P13: object properties without an inverse."""

_AB = ":A a owl:Class . :B a owl:Class . "
_P = ":p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :B . "
_Q = ":q a owl:ObjectProperty ; rdfs:domain :B ; rdfs:range :A . "
_R = ":r a owl:ObjectProperty ; rdfs:domain :B ; rdfs:range :A . "
_LOOP = ":p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :A . "

POSITIVE = {
    "no domain": (":p a owl:ObjectProperty .", [("p",)]),
    "a pair": (_AB + _P + _Q, [("p", "q")]),
    "a pair and a third": (_AB + _P + _Q + _R, [("p", "q"), ("r",)]),
    "a pair, by equivalent classes": (
        _AB + _P + ":q a owl:ObjectProperty ; rdfs:domain :C ; rdfs:range :A . "
        ":C a owl:Class ; owl:equivalentClass :B .",
        [("p", "q")],
    ),
    "a pair, by expressions": (
        _AB + ":p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range [ owl:unionOf ( :A :B ) ] . "
        ":q a owl:ObjectProperty ; rdfs:domain [ owl:unionOf ( :B :A ) ] ; rdfs:range :A .",
        [("p", "q")],
    ),
    "the same names, but not the same": (
        _AB + ":p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range [ owl:unionOf ( :A :B ) ] . "
        ":q a owl:ObjectProperty ; rdfs:domain [ owl:intersectionOf ( :B :A ) ] ; rdfs:range :A .",
        [("p",), ("q",)],
    ),
    "from a class to itself": (_AB + _LOOP, [("p",)]),
    "two from a class to itself are no pair": (
        _AB + _LOOP + ":q a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :A . ",
        [("p",), ("q",)],
    ),
    "asymmetric": (_AB + _LOOP + ":p a owl:AsymmetricProperty .", [("p",)]),
    "the inverse is used without a name": (
        _AB + _P + ":A rdfs:subClassOf [ a owl:Restriction ; owl:someValuesFrom :B ; "
        "owl:onProperty [ owl:inverseOf :p ] ] .",
        [("p",)],
    ),
}
NEGATIVE = {
    "an inverse": _AB + _P + _Q + ":p owl:inverseOf :q .",
    "symmetric": ":p a owl:ObjectProperty , owl:SymmetricProperty .",
    "equivalent to a symmetric one": ":p a owl:ObjectProperty ; owl:equivalentProperty :q . "
    ":q a owl:SymmetricProperty .",
    "an inverse of an equivalent one": ":p a owl:ObjectProperty ; owl:equivalentProperty :q . "
    ":q a owl:ObjectProperty ; owl:inverseOf :r . :r a owl:ObjectProperty .",
    "equivalent to an inverse": ":p a owl:ObjectProperty ; "
    "owl:equivalentProperty [ owl:inverseOf :q ] . :q a owl:ObjectProperty .",
    "a datatype property": ":p a owl:DatatypeProperty .",
    "deprecated": ":p a owl:ObjectProperty ; owl:deprecated true .",
}
STRICT = {
    "a pair, by OOPS!": (_AB + _P + _Q, [("p", "q")]),
    "a partner of two, by OOPS!": (
        _AB + _P + _Q + ":o a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :B . ",
        [("o", "q"), ("p", "q")],
    ),
    "an IRI in the other, by OOPS!": (
        _AB + ":p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :B . "
        ":pp a owl:ObjectProperty ; rdfs:domain :B ; rdfs:range :A . ",
        [("p", "pp")],
    ),
    "both no inverse and a hint, by OOPS!": (_AB + _LOOP, [("p",)]),
    "a hint in spite of the inverse, by OOPS!": (
        _AB + _LOOP + ":p owl:inverseOf :q . :q a owl:ObjectProperty .",
        [("p",)],
    ),
    "the inverse of something undeclared, by OOPS!": (
        ":p a owl:ObjectProperty . :q owl:inverseOf :p .",
        [],
    ),
    "an undeclared inverse, by OOPS!": (
        ":p a owl:ObjectProperty ; owl:inverseOf :q .",
        [("p",)],
    ),
}
