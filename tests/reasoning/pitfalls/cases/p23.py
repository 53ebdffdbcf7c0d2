"""P23: a class for what a datatype is for."""

POSITIVE = {
    "an integer": (""":Integer a owl:Class .""", [("Integer",)]),
    "a range": (
        """
:Date_Time a owl:Class . :when a owl:ObjectProperty ; rdfs:range :Date_Time
.""",
        [("Date_Time",)],
    ),
    "a date as a mere value": (
        """:Date a owl:Class . :when a owl:ObjectProperty ; rdfs:range :Date .""",
        [("Date",)],
    ),
}
NEGATIVE = {
    "a date that nothing has": """:Date a owl:Class .""",
    "a date with properties": """
:Date a owl:Class . :when a owl:ObjectProperty ; rdfs:range :Date .
:year a owl:DatatypeProperty ; rdfs:domain :Date .""",
    "a time with subclasses": """
:Time a owl:Class . :at a owl:ObjectProperty ; rdfs:range :Time .
:Noon a owl:Class ; rdfs:subClassOf :Time .""",
    "a time with conditions": """
:Time a owl:Class ; rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :at
; owl:someValuesFrom :Time ] .
:at a owl:ObjectProperty ; rdfs:range :Time .""",
    "a datatype": """:Integer a rdfs:Datatype .""",
    "a longer name": """:DateOfBirth a owl:Class . :StringInstrument a owl:Class .""",
    "a property": """:integer a owl:DatatypeProperty .""",
    "deprecated": """:Integer a owl:Class ; owl:deprecated true .""",
}
