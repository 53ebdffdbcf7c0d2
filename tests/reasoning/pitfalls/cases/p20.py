"""P20: labels and comments that are empty, equal or swapped."""

POSITIVE = {
    "empty label": (':A a owl:Class ; rdfs:label " " .', [("A",)]),
    "empty comment": (':p a owl:ObjectProperty ; rdfs:comment "" .', [("p",)]),
    "the same": (
        ':A a owl:Class ; rdfs:label "Fire station" ; rdfs:comment "fire station." .',
        [("A",)],
    ),
    "swapped": (
        ':A a owl:Class ; rdfs:label "A building where fire engines stand"@en ; '
        'rdfs:comment "Fire station"@en .',
        [("A",)],
    ),
    "the same in SKOS": (
        ':A a owl:Class ; skos:prefLabel "House"@en ; skos:definition "house"@en .',
        [("A",)],
    ),
    "the second comment repeats the second label": (
        ':A a owl:Class ; rdfs:label "House" ; skos:prefLabel "Hut"@en ; '
        'rdfs:comment "Where people live." ; dcterms:description "hut"@EN .',
        [("A",)],
    ),
    "swapped in SKOS": (
        ':A a owl:Class ; skos:prefLabel "A building where fire engines stand"@en ; '
        'skos:definition "Fire station"@en .',
        [("A",)],
    ),
    "an empty definition": (':A a owl:Class ; skos:definition " " .', [("A",)]),
}
NEGATIVE = {
    "as it should be": ':A a owl:Class ; rdfs:label "House" ; rdfs:comment "Where people live." .',
    "a long label is no swap": ':A a owl:Class ; rdfs:label "fire alarm" ; rdfs:comment "Alarm." .',
    "different languages": (
        ':A a owl:Class ; rdfs:label "Angestellter"@de ; rdfs:comment "angestellter"@nl .'
    ),
    "one comment that explains": (
        ':A a owl:Class ; rdfs:label "one two three four", "one" ; rdfs:comment "Two words." .'
    ),
    "two labels alike": (
        ':A a owl:Class ; rdfs:label "House" ; skos:prefLabel "House" ; '
        'skos:definition "Where people live." .'
    ),
    "deprecated": ':A a owl:Class ; owl:deprecated true ; rdfs:label "" .',
    "no literal": ":A a owl:Class ; rdfs:label :B ; rdfs:comment :B .",
}
STRICT = {
    "OOPS! ignores SKOS": (
        ':A a owl:Class ; skos:prefLabel "House"@en ; skos:definition "house"@en .',
        [],
    ),
    "OOPS! counts words": (
        ':A a owl:Class ; rdfs:label "fire alarm" ; rdfs:comment "Alarm." .',
        [("A",)],
    ),
    "OOPS! needs both": (':A a owl:Class ; rdfs:label "" .', []),
    "OOPS! compares languages": (
        ':A a owl:Class ; rdfs:label "Haus"@de ; rdfs:comment "haus"@nl .',
        [("A",)],
    ),
    "OOPS! finds an empty one": (
        ':A a owl:Class ; rdfs:label "" ; rdfs:comment "What it is." . '
        ':B a owl:Class ; rdfs:label "b" ; rdfs:comment "What it is." .',
        [("A",)],
    ),
}
