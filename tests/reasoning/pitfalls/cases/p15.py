"""P15: "some not" where "not some" may be meant."""

TERMS = """:A a owl:Class . :B a owl:Class . :C a owl:Class .
:p a owl:ObjectProperty . :q a owl:ObjectProperty .
"""

POSITIVE = {
    "as a superclass": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom
[ a owl:Class ; owl:complementOf :B ] ] .""",
        [("A",)],
    ),
    "in a definition": (
        TERMS
        + """
:A owl:equivalentClass [ a owl:Class ; owl:intersectionOf ( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom [ a owl:Class ;
owl:complementOf :B ] ] ) ] .""",
        [("A",)],
    ),
}
NEGATIVE = {
    "not some": TERMS
    + """
:A rdfs:subClassOf [ a owl:Class ; owl:complementOf
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ] .""",
    "some this and not that": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom [ a owl:Class ;
owl:intersectionOf ( :C [ a owl:Class ; owl:complementOf :B ] ) ] ] .""",
    "only too": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom
[ a owl:Class ; owl:complementOf :B ] ] ,
[ a owl:Restriction ; owl:onProperty :p ; owl:allValuesFrom [ a owl:Class ;
owl:complementOf :B ] ] .""",
    "not some too": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom
[ a owl:Class ; owl:complementOf :B ] ] ,
[ a owl:Class ; owl:complementOf [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom :C ] ] .""",
    "only not": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom
[ a owl:Class ; owl:complementOf :B ] ] .""",
    "deprecated": TERMS
    + """
:A owl:deprecated true ; rdfs:subClassOf [ a owl:Restriction ;
owl:onProperty :p ; owl:someValuesFrom
[ a owl:Class ; owl:complementOf :B ] ] .""",
}
