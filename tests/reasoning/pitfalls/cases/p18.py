"""P18: a domain or range that is too narrow."""

TERMS = """:A a owl:Class . :B a owl:Class . :C a owl:Class .
:p a owl:ObjectProperty . :q a owl:ObjectProperty .
"""

POSITIVE = {
    "all subclasses as the domain": (
        TERMS
        + """
:B rdfs:subClassOf :A . :C rdfs:subClassOf :A .
:p rdfs:domain [ a owl:Class ; owl:unionOf ( :B :C ) ] .""",
        [("p",)],
    ),
    "all subclasses as the range": (
        TERMS
        + """
:B rdfs:subClassOf :A . :C rdfs:subClassOf :A .
:p rdfs:range [ a owl:Class ; owl:unionOf ( :C :B ) ] .""",
        [("p",)],
    ),
    "a datatype property": (
        TERMS
        + """
:B rdfs:subClassOf :A . :C rdfs:subClassOf :A . :d a owl:DatatypeProperty ;
rdfs:domain [ a owl:Class ; owl:unionOf ( :C :B ) ] .""",
        [("d",)],
    ),
    "a single individual": (
        TERMS + """:p rdfs:range [ a owl:Class ; owl:oneOf ( :b ) ] .""",
        [("p",)],
    ),
}
NEGATIVE = {
    "the superclass": TERMS
    + """:B rdfs:subClassOf :A . :C rdfs:subClassOf :A . :p rdfs:domain :A .""",
    "not all subclasses": TERMS
    + """
:B rdfs:subClassOf :A . :C rdfs:subClassOf :A . :D a owl:Class ;
rdfs:subClassOf :A .
:p rdfs:domain [ a owl:Class ; owl:unionOf ( :B :C ) ] .""",
    "another class too": TERMS
    + """
:B rdfs:subClassOf :A .
:p rdfs:domain [ a owl:Class ; owl:unionOf ( :B :C ) ] .""",
    "unrelated classes": TERMS + """:p rdfs:domain [ a owl:Class ; owl:unionOf ( :B :C ) ] .""",
    "several individuals": TERMS + """:p rdfs:range [ a owl:Class ; owl:oneOf ( :b :c ) ] .""",
    "a list of data": TERMS
    + """
:d a owl:DatatypeProperty ; rdfs:range [ a rdfs:Datatype ; owl:oneOf ( "x" )
] .""",
    "a broken list": TERMS + """:p rdfs:range [ a owl:Class ; owl:unionOf :B ] .""",
    "deprecated": TERMS
    + """:p owl:deprecated true ; rdfs:range [ a owl:Class ; owl:oneOf ( :b ) ] .""",
}
