"""P30: classes with synonymous names."""

POSITIVE = {
    "two words of one sense": (":Car a owl:Class . :Auto a owl:Class .", [("Auto", "Car")]),
    "names of several words": (
        ":FireEngine a owl:Class . :Fire_Truck a owl:Class .",
        [("FireEngine", "Fire_Truck")],
    ),
    "labels before names": (
        ':X1 a owl:Class ; rdfs:label "car"@en . '
        ':X2 a owl:Class ; skos:prefLabel "automobile"@en .',
        [("X1", "X2")],
    ),
    "three of one sense": (
        ":Car a owl:Class . :Auto a owl:Class . :Automobile a owl:Class .",
        [("Auto", "Automobile", "Car")],
    ),
    "the same word is not compared, another one is": (
        ":Car a owl:Class ; owl:disjointWith :Auto . <https://example.org/q#Car> a owl:Class . "
        ":Auto a owl:Class .",
        [("Auto", "Car")],
    ),
    "a plural": (":Cars a owl:Class . :Automobile a owl:Class .", [("Automobile", "Cars")]),
}
NEGATIVE = {
    "synonyms in a rare sense only": ":Part a owl:Class . :Role a owl:Class .",
    "other meanings": ":Car a owl:Class . :House a owl:Class .",
    "the same word": ':Car a owl:Class . :B a owl:Class ; rdfs:label "car"@en .',
    "equivalent": ":Car a owl:Class ; owl:equivalentClass :B . :Auto owl:equivalentClass :B ; "
    "a owl:Class .",
    "one above the other": (
        ":Car a owl:Class ; rdfs:subClassOf :B . :B rdfs:subClassOf :Auto . :Auto a owl:Class ."
    ),
    "disjoint": ":Car a owl:Class ; owl:disjointWith :Auto . :Auto a owl:Class .",
    "disjoint from what is above": (
        ":Car a owl:Class ; rdfs:subClassOf :B . :Auto a owl:Class . "
        "[] a owl:AllDisjointClasses ; owl:members ( :B :Auto :C ) ."
    ),
    "parts of a disjoint union": (
        ":Car a owl:Class . :Auto a owl:Class . :B owl:disjointUnionOf ( :Car :Auto ) ."
    ),
    "in a circle": (
        ":Car a owl:Class ; rdfs:subClassOf :B . :B rdfs:subClassOf :Auto . "
        ":Auto a owl:Class ; rdfs:subClassOf :Car ."
    ),
    "deprecated": ":Car a owl:Class . :Auto a owl:Class ; owl:deprecated true .",
    "a label in another language": (
        ':Car a owl:Class . :Auto a owl:Class ; rdfs:label "house"@en, "auto"@de .'
    ),
}
STRICT = {
    "OOPS! finds single words": (":Car a owl:Class . :Auto a owl:Class .", [("Auto", "Car")]),
    "OOPS! takes any sense": (
        ":Part a owl:Class . :Role a owl:Class .",
        [("Part", "Role")],
    ),
    "OOPS! ignores what is declared": (
        ":Car a owl:Class ; rdfs:subClassOf :Auto . :Auto a owl:Class .",
        [("Auto", "Car")],
    ),
    "OOPS! takes the spaces out": (
        ':A a owl:Class ; rdfs:label "railway line"@en . '
        ':B a owl:Class ; rdfs:label "rail line"@en .',
        [],
    ),
    "OOPS! knows equivalence": (
        ":Car a owl:Class ; owl:equivalentClass :Auto . :Auto a owl:Class .",
        [],
    ),
}
