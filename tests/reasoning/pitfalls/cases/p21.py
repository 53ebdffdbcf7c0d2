"""P21: a class for what is left over."""

POSITIVE = {
    "other": (":OtherVehicle a owl:Class .", [("OtherVehicle",)]),
    "misc, with a mark": (":road_MISC a owl:Class .", [("road_MISC",)]),
    "the label of a number": (
        ':X_0001 a owl:Class ; rdfs:label "miscellaneous"@en .',
        [("X_0001",)],
    ),
}
NEGATIVE = {
    "no letters and no digits": ':Q_0001 a owl:Class ; rdfs:label "?"@en .',
    "no name": "<https://example.org/o#> a owl:Class .",
    "inside a word": ":Mother a owl:Class . :Another a owl:Class .",
    "other than": ":BuildingOtherThanHouse a owl:Class .",
    "a property": ":other a owl:ObjectProperty .",
    "deprecated": ":OtherVehicle a owl:Class ; owl:deprecated true .",
}
STRICT = {
    "no letters and no digits, by OOPS!": (
        ':Q_0001 a owl:Class ; rdfs:label "?"@en . <https://example.org/o#> a owl:Class .',
        [],
    ),
    "OOPS! takes other than": (
        ":BuildingOtherThanHouse a owl:Class . :Mother a owl:Class .",
        [("BuildingOtherThanHouse",)],
    ),
}
