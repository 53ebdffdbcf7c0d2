"""P09: what the competency questions ask for is missing."""

from pathlib import Path

_QUESTIONS = {"questions": Path(__file__).parents[1] / "resources" / "questions.ttl"}

POSITIVE = {
    "a property": (":Room a owl:Class .", [("partOf",)]),
    "a class and a property": (":House a owl:Class .", [("Room",), ("partOf",)]),
}
NEGATIVE = {
    "all is known": ":Room a owl:Class . :partOf a owl:ObjectProperty .",
    "mentioned is enough": ":Hall a owl:Class ; rdfs:subClassOf :Room ; rdfs:seeAlso :partOf .",
}
OPTIONS = dict.fromkeys((*POSITIVE, *NEGATIVE), _QUESTIONS)
