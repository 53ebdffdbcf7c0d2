"""P25: a property that is its own inverse."""

POSITIVE = {
    "its own inverse": (":p a owl:ObjectProperty ; owl:inverseOf :p .", [("p",)]),
    "symmetric as well": (
        ":p a owl:ObjectProperty, owl:SymmetricProperty ; owl:inverseOf :p .", [("p",)]),
    "and of another": (":p a owl:ObjectProperty ; owl:inverseOf :p, :q .", [("p",)]),
    "equivalent to its own inverse": (
        ":p a owl:ObjectProperty ; owl:equivalentProperty [ owl:inverseOf :p ] .", [("p",)]),
    "equivalent to its own inverse over another": (
        ":m a owl:ObjectProperty ; owl:equivalentProperty :p, [ owl:inverseOf :p ] . "
        ":p a owl:ObjectProperty .", [("p",)]),
}  # fmt: skip
NEGATIVE = {
    "of another": ":p a owl:ObjectProperty ; owl:inverseOf :q . :q a owl:ObjectProperty .",
    "symmetric": ":p a owl:ObjectProperty, owl:SymmetricProperty .",
    "equivalent to the inverse of another": ":p a owl:ObjectProperty ; "
    "owl:equivalentProperty [ owl:inverseOf :q ] . :q a owl:ObjectProperty .",
    "an expression": ":p a owl:ObjectProperty ; rdfs:subPropertyOf [ owl:inverseOf :p ] .",
}
STRICT = {
    "its own inverse, by OOPS!": (":p a owl:ObjectProperty ; owl:inverseOf :p .", [("p",)]),
    "equivalent to its own inverse, by OOPS!": (
        ":p a owl:ObjectProperty ; owl:equivalentProperty [ owl:inverseOf :p ] .", []),
}  # fmt: skip
