"""P24: recursive definitions."""

SOME = "[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom "
P = ":p a owl:ObjectProperty . "

POSITIVE = {
    "a class in its definition": (
        f":A a owl:Class ; owl:equivalentClass {SOME} :A ] . {P}", [("A",)]),
    "deep in what it is below": (
        ":A a owl:Class ; rdfs:subClassOf [ a owl:Class ; owl:intersectionOf (:B "
        f"{SOME} [ a owl:Class ; owl:unionOf (:C :A) ] ] ) ] . {P}", [("A",)]),
    "the definition comes first": (
        "[ a owl:Class ; owl:unionOf (:A :B) ] owl:equivalentClass :A . :A a owl:Class .",
        [("A",)]),
    "a union without an equivalence": (":A a owl:Class ; owl:unionOf (:A :B) .", [("A",)]),
    "a cardinality": (
        ":A a owl:Class ; rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; "
        f"owl:onClass :A ; owl:maxQualifiedCardinality 1 ] . {P}", [("A",)]),
    "below itself": (":A a owl:Class ; rdfs:subClassOf :A .", [("A",)]),
    "equivalent to itself": (":A a owl:Class ; owl:equivalentClass :A .", [("A",)]),
    "a property in its domain": (
        f":p a owl:ObjectProperty ; rdfs:domain {SOME} :A ] .", [("p",)]),
    "a property in its range": (
        f":p a owl:ObjectProperty ; rdfs:range {SOME} :A ] .", [("p",)]),
    "a datatype property in its domain": (
        ":d a owl:DatatypeProperty ; rdfs:domain [ a owl:Restriction ; owl:onProperty :d ; "
        "owl:minCardinality 1 ] .", [("d",)]),
}  # fmt: skip
NEGATIVE = {
    "another class": f":A a owl:Class ; owl:equivalentClass {SOME} :B ] . {P}",
    "another property": f":q a owl:ObjectProperty ; rdfs:domain {SOME} :A ] . {P}",
    "its own inverse": ":p a owl:ObjectProperty ; owl:inverseOf :p .",
    "over another class": f":A a owl:Class ; rdfs:subClassOf :B . :B a owl:Class ; "
    f"rdfs:subClassOf {SOME} :A ] . {P}",
    "a transitive chain": ":p a owl:ObjectProperty ; owl:propertyChainAxiom (:p :p) .",
    "disjoint": ":A a owl:Class ; owl:disjointWith [ a owl:Class ; owl:complementOf :A ] .",
}
STRICT = {
    "its own inverse counts": (":p a owl:ObjectProperty ; owl:inverseOf :p .", [("p",)]),
    "a class in its definition, by OOPS!": (
        f":A a owl:Class ; owl:equivalentClass {SOME} :A ] . {P}", [("A",)]),
    "restrictions of other than object properties are left out": (
        f":A a owl:Class ; owl:equivalentClass {SOME} :A ] .", []),
    "cardinalities are left out": (
        ":A a owl:Class ; rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; "
        f"owl:onClass :A ; owl:maxQualifiedCardinality 1 ] . {P}", []),
    "below itself is left out": (":A a owl:Class ; rdfs:subClassOf :A .", []),
    "properties": (
        f":p a owl:ObjectProperty ; rdfs:range [ a owl:Class ; owl:intersectionOf (:B {SOME} :A "
        "] ) ] . :d a owl:DatatypeProperty ; rdfs:domain [ a owl:Restriction ; owl:onProperty :d "
        "; owl:minCardinality 1 ] .", [("p",), ("d",)]),
    "one's own property is in no class": (":q a owl:ObjectProperty ; rdfs:domain :q .", []),
}  # fmt: skip
