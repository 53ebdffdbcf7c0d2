"""P03: a property called "is"."""

POSITIVE = {
    "is": (":is a owl:ObjectProperty .", [("is",)]),
    "is_a, in capitals": (":IS_A a owl:ObjectProperty .", [("IS_A",)]),
}
NEGATIVE = {
    "isPartOf": ":isPartOf a owl:ObjectProperty .",
    "an annotation property": ":isA a owl:AnnotationProperty .",
}
STRICT = {
    "is, by OOPS!": (":is a owl:ObjectProperty .", [("is",)]),
}
