"""P16: a definition that is written as a mere condition."""

TERMS = """:A a owl:Class . :B a owl:Class . :C a owl:Class .
:p a owl:ObjectProperty . :q a owl:ObjectProperty .
"""

POSITIVE = {
    "a kind and a restriction": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Class ; owl:intersectionOf ( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ) ] .""",
        [("A",)],
    ),
    "an intersection in an intersection": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Class ; owl:intersectionOf ( :B
[ a owl:Class ; owl:intersectionOf ( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ) ] ) ] .""",
        [("A",)],
    ),
}
NEGATIVE = {
    "a definition": TERMS
    + """
:A owl:equivalentClass [ a owl:Class ; owl:intersectionOf ( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ) ] .""",
    "both": TERMS
    + """
:A owl:equivalentClass :B ; rdfs:subClassOf [ a owl:Class ;
owl:intersectionOf ( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ) ] .""",
    "a definition from the other side": TERMS
    + """
:A rdfs:subClassOf [ a owl:Class ; owl:intersectionOf ( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ) ] . :B
owl:equivalentClass :A .""",
    "two superclasses": TERMS
    + """
:A rdfs:subClassOf :C , [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom :B ] .""",
    "restrictions only": TERMS
    + """
:A rdfs:subClassOf [ a owl:Class ; owl:intersectionOf (
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] [ a
owl:Restriction ; owl:onProperty :q ; owl:someValuesFrom :B ] ) ] .""",
    "classes only": TERMS
    + """:A rdfs:subClassOf [ a owl:Class ; owl:intersectionOf ( :B :C ) ] .""",
    "a union": TERMS
    + """
:A owl:disjointUnionOf ( :B :C ) ; rdfs:subClassOf [ a owl:Class ;
owl:intersectionOf ( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ) ] .""",
    "deprecated": TERMS
    + """
:A owl:deprecated true ; rdfs:subClassOf [ a owl:Class ; owl:intersectionOf
( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ) ] .""",
}
