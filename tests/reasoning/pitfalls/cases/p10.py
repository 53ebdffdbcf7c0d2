"""P10: no two classes are said to be disjoint."""

_TWO = ":A a owl:Class . :B a owl:Class . "

POSITIVE = {
    "two roots": (_TWO, [()]),
    "two siblings": (
        _TWO + ":C a owl:Class . :A rdfs:subClassOf :C . :B rdfs:subClassOf :C .",
        [()],
    ),
    "disjoint properties only": (
        _TWO + ":p a owl:ObjectProperty ; owl:propertyDisjointWith :q . :q a owl:ObjectProperty .",
        [()],
    ),
    "an empty class": (_TWO + ":A rdfs:subClassOf owl:Nothing .", [()]),
    "what is in both is something": (
        _TWO + ":C a owl:Class ; owl:equivalentClass [ owl:intersectionOf ( :A :B ) ] .",
        [()],
    ),
    "a complement that says nothing of a class": (
        _TWO + ":p a owl:ObjectProperty ; rdfs:domain [ a owl:Class ; owl:complementOf :A ] .",
        [()],
    ),
}
NEGATIVE = {
    "disjointWith": _TWO + ":A owl:disjointWith :B .",
    "AllDisjointClasses": _TWO + "[] a owl:AllDisjointClasses ; owl:members ( :A :B ) .",
    "disjointUnionOf": _TWO + ":C a owl:Class ; owl:disjointUnionOf ( :A :B ) .",
    "below a complement": _TWO + ":A rdfs:subClassOf [ a owl:Class ; owl:complementOf :B ] .",
    "a complement by name": _TWO + ":A owl:complementOf :B .",
    "nothing is in both": _TWO + "[] a owl:Class ; owl:intersectionOf ( :A :B ) ; "
    "rdfs:subClassOf owl:Nothing .",
    "what is in both is the same as nothing": _TWO + "owl:Nothing owl:equivalentClass "
    "[ a owl:Class ; owl:intersectionOf ( :A :B ) ] .",
    "what is in both has a name": _TWO + ":Both a owl:Class ; rdfs:subClassOf owl:Nothing ; "
    "owl:equivalentClass [ a owl:Class ; owl:intersectionOf ( :A :B ) ] .",
    "one class": ":A a owl:Class .",
    "a chain": _TWO + ":A rdfs:subClassOf :B . :B rdfs:subClassOf owl:Thing .",
    "equivalent": _TWO + ":A owl:equivalentClass :B .",
    "one is deprecated": _TWO + ":A owl:deprecated true .",
}
STRICT = {
    "a chain, by OOPS!": (_TWO + ":A rdfs:subClassOf :B .", [()]),
    "below a complement, by OOPS!": (
        _TWO + ":A rdfs:subClassOf [ a owl:Class ; owl:complementOf :B ] .",
        [()],
    ),
    "AllDisjointClasses, by OOPS!": (
        _TWO + "[] a owl:AllDisjointClasses ; owl:members ( :A :B ) .",
        [],
    ),
    "one class, by OOPS!": (":A a owl:Class .", []),
}
