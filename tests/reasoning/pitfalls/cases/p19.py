"""P19: several domains or ranges."""

CLASSES = ":A a owl:Class . :B a owl:Class . :C a owl:Class . "
P = ":p a owl:ObjectProperty ; "
D = ":d a owl:DatatypeProperty ; "

POSITIVE = {
    "two domains": (f"{P} rdfs:domain :A, :B . {CLASSES}", [("p",)]),
    "two ranges": (f"{P} rdfs:range :A, :B . {CLASSES}", [("p",)]),
    "domains of a datatype property": (f"{D} rdfs:domain :A, :B . {CLASSES}", [("d",)]),
    "two datatypes": (f"{D} rdfs:range xsd:int, xsd:string .", [("d",)]),
    "a class and one above it": (
        f"{P} rdfs:domain :A, :B . {CLASSES} :A rdfs:subClassOf :C . :C rdfs:subClassOf :B .",
        [("p",)]),
    "a class and a union": (
        f"{P} rdfs:range :C, [ a owl:Class ; owl:unionOf (:A :B) ] . {CLASSES}", [("p",)]),
    "a third one": (
        f"{P} rdfs:domain :A, :B, :C . {CLASSES} :A owl:equivalentClass :B .", [("p",)]),
}  # fmt: skip
NEGATIVE = {
    "a domain and a range": f"{P} rdfs:domain :A ; rdfs:range :B . {CLASSES}",
    "equivalent classes": f"{P} rdfs:domain :A, :B . {CLASSES} :B owl:equivalentClass :A .",
    "equivalent over a third": f"{P} rdfs:domain :A, :B . {CLASSES} "
    ":B owl:equivalentClass :C . :A owl:equivalentClass :C .",
    "one union twice": f"{P} rdfs:range [ a owl:Class ; owl:unionOf (:A :B) ] , "
    f"[ a owl:Class ; owl:unionOf (:B :A) ] . {CLASSES}",
    "equivalent datatypes": f"{D} rdfs:range xsd:string, :text . "
    ":text a rdfs:Datatype ; owl:equivalentClass xsd:string .",
    "an annotation property": f":n a owl:AnnotationProperty ; rdfs:domain :A, :B . {CLASSES}",
}
STRICT = {
    "one finding a property": (
        f"{P} rdfs:domain :A, :B ; rdfs:range :A, :B . {CLASSES}", [("p",)]),
    "equivalent datatypes count": (
        f"{D} rdfs:range xsd:string, :text . "
        ":text a rdfs:Datatype ; owl:equivalentClass xsd:string .", [("d",)]),
    "equivalent classes do not": (
        f"{P} rdfs:domain :A, :B . {CLASSES} :B owl:equivalentClass :A .", []),
    "equivalent over a third counts": (
        f"{P} rdfs:domain :A, :B . {CLASSES} "
        ":B owl:equivalentClass :C . :A owl:equivalentClass :C .", [("p",)]),
    "domains of a datatype property, by OOPS!": (
        f"{D} rdfs:domain :A, :B . {CLASSES}", [("d",)]),
}  # fmt: skip
