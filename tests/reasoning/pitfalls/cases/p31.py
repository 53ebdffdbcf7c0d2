"""P31: equivalent classes that WordNet tells apart."""

POSITIVE = {
    "a kind": (
        ":Car a owl:Class ; owl:equivalentClass :Vehicle . :Vehicle a owl:Class .",
        [("Car", "Vehicle")],
    ),
    "a part": (
        ":Hand a owl:Class ; owl:equivalentClass :Finger . :Finger a owl:Class .",
        [("Finger", "Hand")],
    ),
    "stated both ways, once": (
        ":Car a owl:Class ; owl:equivalentClass :Vehicle . "
        ":Vehicle a owl:Class ; owl:equivalentClass :Car .",
        [("Car", "Vehicle")],
    ),
    "after the words that they share": (
        ":ElectricCar a owl:Class ; owl:equivalentClass :ElectricVehicle .",
        [("ElectricCar", "ElectricVehicle")],
    ),
    "over a third": (
        ":Aaa a owl:Class ; owl:equivalentClass :Dog, :Animal . :Dog a owl:Class .",
        [("Animal", "Dog")],
    ),
}
NEGATIVE = {
    "synonyms": ":Car a owl:Class ; owl:equivalentClass :Automobile .",
    "letters": ":ClassA a owl:Class ; owl:equivalentClass :ClassB .",
    "no words": ":Zqxa a owl:Class ; owl:equivalentClass :Zqxb .",
    "the same name": ":Car a owl:Class ; owl:equivalentClass <https://example.org/p#Car> .",
    "both said to be nothing": ":Car a owl:Class ; owl:equivalentClass owl:Nothing . "
    ":Vehicle a owl:Class ; owl:equivalentClass owl:Nothing .",
    "not declared": ":Car a owl:Class . :Vehicle a owl:Class .",
    "a defined class": ":Car a owl:Class ; owl:equivalentClass [ owl:unionOf ( :Vehicle :B ) ] .",
    "deprecated": ":Car a owl:Class ; owl:deprecated true ; owl:equivalentClass :Vehicle .",
    "to itself, and to a text": ':Car a owl:Class ; owl:equivalentClass :Car, "Vehicle" .',
}
STRICT = {
    "OOPS! takes letters for words": (
        ":ClassA a owl:Class ; owl:equivalentClass :ClassB . :ClassB a owl:Class .",
        [("ClassA", "ClassB")],
    ),
    "OOPS! finds kinds": (
        ":Car a owl:Class ; owl:equivalentClass :Vehicle . :Vehicle a owl:Class .",
        [("Car", "Vehicle")],
    ),
    "OOPS! finds no parts": (
        ":Hand a owl:Class ; owl:equivalentClass :Finger . :Finger a owl:Class .",
        [],
    ),
    "OOPS! knows synonyms word by word": (
        ":RedCar a owl:Class ; owl:equivalentClass :RedAuto . :RedAuto a owl:Class .",
        [],
    ),
    "OOPS! compares letters": (
        ":Car_Park a owl:Class ; owl:equivalentClass :carPark . :carPark a owl:Class .",
        [],
    ),
}
