"""P33: property chains of one property."""

P = ":p a owl:ObjectProperty ; owl:propertyChainAxiom "

POSITIVE = {
    "one property": (f"{P} (:q) . :q a owl:ObjectProperty ; owl:inverseOf :r .", [("p",)]),
    "an inverse": (f"{P} ([ owl:inverseOf :q ]) . :q a owl:ObjectProperty .", [("p",)]),
    "none": (f"{P} () .", [("p",)]),
    "one of two chains": (f"{P} (:q :r), (:q) . :q a owl:ObjectProperty .", [("p",)]),
    "an anonymous node": (f"{P} ([ a owl:ObjectProperty ]) .", [("p",)]),
}
NEGATIVE = {
    "two properties": f"{P} (:q :r) . :q a owl:ObjectProperty . :r a owl:ObjectProperty .",
    "one property twice": f"{P} (:q :q) . :q a owl:ObjectProperty .",
    "a sub-property": ":p a owl:ObjectProperty ; rdfs:subPropertyOf :q .",
}
STRICT = {
    "one property, by OOPS!": (f"{P} (:q), (:r) . :q a owl:ObjectProperty .", [("p",)]),
    "an inverse is not looked for": (f"{P} ([ owl:inverseOf :q ]) .", []),
}
