"""P07: a name that joins two concepts."""

POSITIVE = {
    "and": (":StyleAndPeriod a owl:Class .", [("StyleAndPeriod",)]),
    "or, joined with underscores": (":road_or_river a owl:Class .", [("road_or_river",)]),
    "the label of a number": (
        ':X_0001 a owl:Class ; rdfs:label "gravel and mud"@en .',
        [("X_0001",)],
    ),
    "after an acronym": (":HTMLAndText a owl:Class .", [("HTMLAndText",)]),
}
NEGATIVE = {
    "WordNet knows it": ":BedAndBreakfast a owl:Class .",
    "WordNet knows a part of it": ":CheapBedAndBreakfastPlace a owl:Class .",
    "WordNet knows it as an adjective": ":BlackAndWhite a owl:Class .",
    "the letters inside a word": ":Sandwich a owl:Class . :Corridor a owl:Class .",
    "nothing to join": ":AndStyle a owl:Class . :Or a owl:Class .",
    "deprecated": ":StyleAndPeriod a owl:Class ; owl:deprecated true .",
    "a property": ":styleAndPeriod a owl:ObjectProperty .",
}
STRICT = {
    "OOPS! looks at the ends too": (":AndStyle a owl:Class .", [("AndStyle",)]),
    "OOPS! looks up the whole": (
        ":CheapBedAndBreakfastPlace a owl:Class . :BedAndBreakfast a owl:Class .",
        [("CheapBedAndBreakfastPlace",)],
    ),
    "OOPS! does not look at labels": (':X_0001 a owl:Class ; rdfs:label "a and b"@en .', []),
}
