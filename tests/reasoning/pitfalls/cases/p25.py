"""P25: a property that is its own inverse."""

POSITIVE = {
    "its own inverse": (":p a owl:ObjectProperty ; owl:inverseOf :p .", [("p",)]),
    "symmetric as well": (
        ":p a owl:ObjectProperty, owl:SymmetricProperty ; owl:inverseOf :p .", [("p",)]),
    "and of another": (":p a owl:ObjectProperty ; owl:inverseOf :p, :q .", [("p",)]),
}  # fmt: skip
NEGATIVE = {
    "of another": ":p a owl:ObjectProperty ; owl:inverseOf :q . :q a owl:ObjectProperty .",
    "symmetric": ":p a owl:ObjectProperty, owl:SymmetricProperty .",
    "an expression": ":p a owl:ObjectProperty ; rdfs:subPropertyOf [ owl:inverseOf :p ] .",
}
