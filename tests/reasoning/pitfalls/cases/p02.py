"""P02: synonyms as classes."""

POSITIVE = {
    "two names": (":Car a owl:Class ; owl:equivalentClass :Auto . :Auto a owl:Class .",
                  [("Auto", "Car")]),
    "stated both ways is one finding": (
        ":Car a owl:Class ; owl:equivalentClass :Auto . "
        ":Auto a owl:Class ; owl:equivalentClass :Car .", [("Auto", "Car")]),
    "three names": (
        ":A a owl:Class ; owl:equivalentClass :B . :B a owl:Class ; owl:equivalentClass :C . "
        ":C a owl:Class .", [("A", "B"), ("A", "C")]),
    "three names, said of another": (
        ":B a owl:Class ; owl:equivalentClass :A, :C . :A a owl:Class . :C a owl:Class .",
        [("A", "B"), ("A", "C")]),
}  # fmt: skip
NEGATIVE = {
    "by way of another vocabulary": ":Car a owl:Class ; owl:equivalentClass <http://e.com/A> . "
    ":Auto a owl:Class ; owl:equivalentClass <http://e.com/A> .",
    "by way of a deprecated class": ":Car a owl:Class ; owl:equivalentClass :Wagon . "
    ":Auto a owl:Class ; owl:equivalentClass :Wagon . :Wagon owl:deprecated true .",
    "of another vocabulary": ":Car a owl:Class ; owl:equivalentClass <https://example.com/Auto> .",
    "one name in two cases": ":Car a owl:Class ; owl:equivalentClass :CAR . :CAR a owl:Class .",
    "one of them deprecated": ":Car a owl:Class ; owl:equivalentClass :Auto . "
    ":Auto a owl:Class ; owl:deprecated true .",
    "one of them a deprecated class": ":Car a owl:Class ; owl:equivalentClass :Auto . "
    ":Auto a owl:Class, owl:DeprecatedClass .",
    "a definition": ":Car a owl:Class ; owl:equivalentClass [ a owl:Class ; "
    "owl:unionOf (:A :B) ] .",
    "datatypes": ":length a rdfs:Datatype ; owl:equivalentClass :size . :size a rdfs:Datatype .",
    "a literal": ':Car a owl:Class ; owl:equivalentClass "Auto" .',
    "owl:Thing": ":Car a owl:Class ; owl:equivalentClass owl:Thing .",
}
STRICT = {
    "the subject alone": (":Car a owl:Class ; owl:equivalentClass :Auto . :Auto a owl:Class .",
                          [("Car",)]),
    "both subjects": (
        ":Car a owl:Class ; owl:equivalentClass :Auto . "
        ":Auto a owl:Class ; owl:equivalentClass :Car .", [("Car",), ("Auto",)]),
    "deprecated all the same": (
        ":Car a owl:Class ; owl:equivalentClass :Auto . "
        ":Auto a owl:Class ; owl:deprecated true .", [("Car",)]),
}  # fmt: skip
