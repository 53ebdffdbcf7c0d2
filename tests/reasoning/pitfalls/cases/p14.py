"""P14: "only" where "some" may be meant."""

TERMS = """:A a owl:Class . :B a owl:Class . :C a owl:Class .
:p a owl:ObjectProperty . :q a owl:ObjectProperty .
"""

POSITIVE = {
    "as a superclass": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] .""",
        [("A",)],
    ),
    "in a definition": (
        TERMS
        + """
:A owl:equivalentClass [ a owl:Class ; owl:intersectionOf ( :C
[ a owl:Restriction ; owl:onProperty :p ; owl:allValuesFrom :B ] ) ] .""",
        [("A",)],
    ),
    "in a definition from the other side": (
        TERMS
        + """
[ a owl:Restriction ; owl:onProperty :p ; owl:allValuesFrom :B ]
owl:equivalentClass :A .""",
        [("A",)],
    ),
    "some of another property": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :q ; owl:someValuesFrom :B ] .""",
        [("A",)],
    ),
    "at least none": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :p ; owl:minCardinality 0 ] .""",
        [("A",)],
    ),
    "at most one": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :p ; owl:maxCardinality 1 ] .""",
        [("A",)],
    ),
    "some in a subclass": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] .
:C rdfs:subClassOf :A ,[ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom :B ] .""",
        [("A",)],
    ),
    "two properties": (
        TERMS
        + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :q ; owl:allValuesFrom :B ] .""",
        [("A",), ("A",)],
    ),
}
NEGATIVE = {
    "closed": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] .""",
    "a value by name": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :p ; owl:hasValue :b ] .""",
    "at least one": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :p ; owl:minCardinality
"1"^^xsd:nonNegativeInteger ] .""",
    "exactly one of a kind": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :p ; owl:qualifiedCardinality 1 ;
owl:onClass :B ] .""",
    "inherited": TERMS
    + """
:A rdfs:subClassOf :C , [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] .
:C rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom owl:Thing ] .""",
    "inherited in a circle": TERMS
    + """
:A rdfs:subClassOf :C , [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] .
:C rdfs:subClassOf :A , [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom owl:Thing ] .""",
    "inherited from a definition": TERMS
    + """
:A rdfs:subClassOf :C , [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] .
:C owl:equivalentClass [ a owl:Class ;
owl:intersectionOf ( :B [ a owl:Restriction ; owl:onProperty :p ;
owl:someValuesFrom owl:Thing ] ) ] .""",
    "some of a sub-property": TERMS
    + """
:q rdfs:subPropertyOf :p .
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom :B ] ,
[ a owl:Restriction ; owl:onProperty :q ; owl:someValuesFrom :B ] .""",
    "only nothing": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom owl:Nothing ] .""",
    "only not": TERMS
    + """
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
owl:allValuesFrom [ a owl:Class ;
owl:complementOf :B ] ] .""",
    "a datatype": TERMS
    + """
:d a owl:DatatypeProperty .
:A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :d ;
owl:allValuesFrom xsd:integer ] .""",
    "below an unknown class": TERMS
    + """
:A rdfs:subClassOf <https://example.org/y#Z> ,
[ a owl:Restriction ; owl:onProperty :p ; owl:allValuesFrom :B ] .""",
    "deprecated": TERMS
    + """
:A owl:deprecated true ; rdfs:subClassOf [ a owl:Restriction ;
owl:onProperty :p ; owl:allValuesFrom :B ] .""",
    "negated": TERMS
    + """
:A rdfs:subClassOf [ a owl:Class ; owl:complementOf
[ a owl:Restriction ; owl:onProperty :p ; owl:allValuesFrom :B ] ] .""",
    "a broken list": TERMS
    + """
:A owl:equivalentClass [ a owl:Class ; owl:intersectionOf :B ] .
:B rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :q ;
owl:allValuesFrom "x" ] , [ a owl:Restriction ; owl:onProperty :q ;
owl:someValuesFrom :A ] .""",
}
