"""P23: a class for what a datatype is for."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDFS, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.conditions import left_to_people
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P23",
    title="Duplicating a datatype already provided by the implementation language",
    severity=Severity.IMPORTANT,
    affects=("class",),
    categories=("N1", "S6"),
    description="A class stands for numbers, texts, dates or the like, for which the language has "
    "datatypes. Its individuals have no value that anything could compare.",
    remedy="Use a datatype property with the datatype (xsd:integer, xsd:string, xsd:date ...) in "
    "place of the class.",
    advisory=True,
)


_PLAIN = {
    "integer": "xsd:integer", "int": "xsd:integer", "string": "xsd:string", "float": "xsd:float",
    "boolean": "xsd:boolean", "bool": "xsd:boolean", "double": "xsd:double",
    "decimal": "xsd:decimal", "datetime": "xsd:dateTime", "datetimestamp": "xsd:dateTimeStamp",
    "anyuri": "xsd:anyURI", "literal": "rdfs:Literal",
}  # fmt: skip
# Words of everyday language too: they count where the class is nothing but the value of properties.
_AMBIGUOUS = {
    "date": "xsd:date", "time": "xsd:time", "number": "xsd:decimal", "duration": "xsd:duration",
    "text": "xsd:string", "year": "xsd:gYear",
}  # fmt: skip


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Classes with the name of a datatype; a declared datatype is none."""
    described = _described(ontology)
    for cls in ontology.classes:
        name = local_name(cls).replace("_", "").replace("-", "").lower()
        datatype = _PLAIN.get(name) or _AMBIGUOUS.get(name)
        if not datatype or RDFS.Datatype in ontology.kinds[cls] or ontology.deprecated(cls):
            continue
        ranges = _ranges(ontology, cls)
        if name in _AMBIGUOUS and (not ranges or cls in described):
            continue
        values = ", ".join(local_name(str(triple[0])) for triple in ranges)
        used = f", and is the range of {values}" if ranges else ""
        yield Finding(
            (cls,),
            f"it is a class with the name of the datatype {datatype}{used}",
            tuple(ranges),
            f"Use {datatype} as the range of datatype properties in place of the class.",
        )


def _ranges(ontology: Ontology, cls: URIRef) -> list[Triple]:
    """The ranges of object properties that are the class."""
    return [
        (prop, RDFS.range, cls)
        for prop in ontology.object_properties
        if cls in ontology.objects(prop, RDFS.range)
    ]


def _described(ontology: Ontology) -> set[Node]:
    """Classes with properties, conditions or subclasses of their own: more than a plain value."""
    found: set[Node] = set(ontology.equivalents)
    for objects in ontology.statements(RDFS.domain).values():
        found.update(objects)
    for s, objects in ontology.statements(RDFS.subClassOf).items():
        found.update(o for o in objects if o != s)
        if any(ontology.objects(o, OWL.onProperty) for o in objects):
            found.add(s)
    return found


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
