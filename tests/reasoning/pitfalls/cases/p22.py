"""P22: names that follow different conventions."""

POSITIVE = {
    "a class in small letters": (
        ":House a owl:Class . :Road a owl:Class . :river a owl:Class .",
        [("river",)],
    ),
    "as many of each: classes have a capital": (
        ":House a owl:Class . :river a owl:Class .",
        [("river",)],
    ),
    "as many of each: properties have none": (
        ":HasPart a owl:ObjectProperty . :isPart a owl:ObjectProperty .",
        [("HasPart",)],
    ),
    "underscores": (
        ":hasPart a owl:DatatypeProperty . :has_part a owl:DatatypeProperty . "
        ":has_name a owl:DatatypeProperty . :name a owl:DatatypeProperty .",
        [("hasPart",)],
    ),
    "one finding for each kind": (
        ":House a owl:Class . :river a owl:Class . :p a owl:ObjectProperty . "
        ":q a owl:ObjectProperty . :Quality a owl:ObjectProperty .",
        [("river",), ("Quality",)],
    ),
    "one finding for each name": (
        ":House a owl:Class . :Road a owl:Class . :Wood a owl:Class . "
        ":river a owl:Class . :lake a owl:Class .",
        [("river",), ("lake",)],
    ),
    "hyphens and capitals in one finding": (
        ":HouseBoat a owl:Class . :RoadBridge a owl:Class . :river-bank a owl:Class .",
        [("river-bank",)],
    ),
}
NEGATIVE = {
    "classes and properties differ": (
        ":House a owl:Class . :hasPart a owl:ObjectProperty . :has_name a owl:DatatypeProperty ."
    ),
    "one word fits both": ":House a owl:Class . :House_Boat a owl:Class .",
    "acronyms": ":name a owl:DatatypeProperty . :ISBN a owl:DatatypeProperty .",
    "numbers": ":House a owl:Class . :x_00012 a owl:Class .",
    "each namespace has its own": (
        ":House a owl:Class . <https://example.org/p#river> a owl:Class ."
    ),
    "deprecated": ":House a owl:Class . :river a owl:Class ; owl:deprecated true .",
    "no letters": ":House a owl:Class . <https://example.org/o#家> a owl:Class .",
    "both marks": ":a_b-c a owl:ObjectProperty .",
}
STRICT = {
    "OOPS! remembers marks across kinds": (
        ":HouseBoat a owl:Class . :has_part a owl:ObjectProperty .",
        [("has_part", "HouseBoat")],
    ),
    "OOPS! mixes namespaces": (
        "<https://example.org/o#House> a owl:Class . <https://example.org/p#river> a owl:Class .",
        [("river", "House")],
    ),
    "OOPS! takes an untyped sub-property for a class": (
        ":House a owl:Class . :part rdfs:subPropertyOf :hasPart . :hasPart a owl:ObjectProperty .",
        [("part", "House")],
    ),
    "no mix": (":House a owl:Class . :hasPart a owl:ObjectProperty .", []),
}
