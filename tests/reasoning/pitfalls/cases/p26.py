"""P26: symmetric properties with an inverse."""

P = ":p a owl:ObjectProperty, owl:SymmetricProperty "

POSITIVE = {
    "an inverse": (f"{P} ; owl:inverseOf :q . :q a owl:ObjectProperty .", [("p",)]),
    "stated by the other": (f"{P} . :q a owl:ObjectProperty ; owl:inverseOf :p .", [("p",)]),
    "both symmetric": (
        f"{P} ; owl:inverseOf :q . :q a owl:SymmetricProperty ; owl:inverseOf :p .",
        [("p",), ("q",)]),
    "equivalent to the inverse of another": (
        f"{P} ; owl:equivalentProperty [ owl:inverseOf :q ] . :q a owl:ObjectProperty .",
        [("p",)]),
}  # fmt: skip
NEGATIVE = {
    "not symmetric": ":p a owl:ObjectProperty ; owl:inverseOf :q . :q a owl:ObjectProperty .",
    "its own inverse": f"{P} ; owl:inverseOf :p .",
    "equivalent to its own inverse": f"{P} ; owl:equivalentProperty [ owl:inverseOf :p ] .",
    "an expression": f"{P} . :q a owl:ObjectProperty ; rdfs:subPropertyOf [ owl:inverseOf :p ] .",
}
STRICT = {
    "its own inverse counts": (f"{P} ; owl:inverseOf :p .", [("p",)]),
    "equivalent to the inverse of another, by OOPS!": (
        f"{P} ; owl:equivalentProperty [ owl:inverseOf :q ] . :q a owl:ObjectProperty .",
        [],
    ),
    "an inverse, by OOPS!": (f"{P} . :q a owl:ObjectProperty ; owl:inverseOf :p .", [("p",)]),
}
