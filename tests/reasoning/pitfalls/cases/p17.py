"""P17: a class that is an individual."""

POSITIVE = {
    "the same name": (
        """
:City a owl:Class . :Madrid a owl:Class ; rdfs:subClassOf :City .
:madrid a :Madrid , owl:NamedIndividual .""",
        [("Madrid",)],
    ),
    "other signs in the name": (
        """
:City a owl:Class . :NewYork a owl:Class ; rdfs:subClassOf :City .
:new_york a :NewYork .""",
        [("NewYork",)],
    ),
}
NEGATIVE = {
    "another name": """
:City a owl:Class . :Madrid a owl:Class ; rdfs:subClassOf :City .
:capital a :Madrid .""",
    "no individual": """:City a owl:Class . :Madrid a owl:Class ; rdfs:subClassOf :City .""",
    "two individuals": """
:City a owl:Class . :Madrid a owl:Class ; rdfs:subClassOf :City .
:madrid a :Madrid . :madrid2 a :Madrid .""",
    "a subclass": """
:City a owl:Class . :Madrid a owl:Class ; rdfs:subClassOf :City .
:madrid a :Madrid . :Suburb a owl:Class ; rdfs:subClassOf :Madrid .""",
    "parts of a disjoint union": """
:City a owl:Class . :Madrid a owl:Class ; rdfs:subClassOf :City .
:madrid a :Madrid . :B a owl:Class . :C a owl:Class .
:Madrid owl:disjointUnionOf ( :B :C ) .""",
    "no superclass": """:Madrid a owl:Class . :madrid a :Madrid .""",
    "an individual without a name": """
:City a owl:Class . :Madrid a owl:Class ; rdfs:subClassOf :City .
[] a :Madrid .""",
    "deprecated": """
:City a owl:Class . :Madrid a owl:Class ; rdfs:subClassOf :City .
:Madrid owl:deprecated true . :madrid a :Madrid .""",
}
