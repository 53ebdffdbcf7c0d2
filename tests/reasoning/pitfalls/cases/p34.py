"""P34: what is used as a class is not declared as one."""

_P = ":p a owl:ObjectProperty ; "
_A = ":A a owl:Class ; "
_SOME = _P.replace(";", ".") + _A + "rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; "

_RULE = (
    "@prefix swrl: <http://www.w3.org/2003/11/swrl#> . :x a swrl:Variable . "
    "[] a swrl:Imp ; swrl:body [ a swrl:AtomList ; rdf:rest () ; rdf:first "
    "[ a swrl:ClassAtom ; swrl:classPredicate :A ; swrl:argument1 :x ] ] ; "
    "swrl:head [ a swrl:AtomList ; rdf:rest () ; rdf:first [ a swrl:IndividualPropertyAtom ; "
    "swrl:propertyPredicate :p ; swrl:argument1 :x ; swrl:argument2 :x ] ] . "
)

POSITIVE = {
    "a domain": (_P + "rdfs:domain :X .", [("X",)]),
    "a range": (_P + "rdfs:range :X .", [("X",)]),
    "a type": (":i a :X .", [("X",)]),
    "above": (_A + "rdfs:subClassOf :X .", [("X",)]),
    "below": (":A a owl:Class . :X rdfs:subClassOf :A .", [("X",)]),
    "equivalent": (_A + "owl:equivalentClass :X .", [("X",)]),
    "disjoint": (":A a owl:Class . :X owl:disjointWith :A .", [("X",)]),
    "a filler": (_SOME + "owl:someValuesFrom :X ] .", [("X",)]),
    "a filler with a number": (_SOME + "owl:onClass :X ; owl:qualifiedCardinality 1 ] .", [("X",)]),
    "in a union": (_P + "rdfs:domain [ a owl:Class ; owl:unionOf ( :X :Y ) ] .", [("X",), ("Y",)]),
    "in a list of disjoint classes": (
        ":A a owl:Class . [] a owl:AllDisjointClasses ; owl:members ( :A :X ) .",
        [("X",)],
    ),
    "a property as a class": (_P + "rdfs:domain :p .", [("p",)]),
    "a datatype of nobody's": (":p a owl:DatatypeProperty ; rdfs:range :X .", [("X",)]),
    "it has a label": (_P + 'rdfs:domain :X . :X rdfs:label "x" .', [("X",)]),
    "in a rule": (_P.replace(";", ".") + _RULE, [("A",)]),
}
NEGATIVE = {
    "a rule": _RULE + ":A a owl:Class . :p a owl:ObjectProperty .",
    "declared": _P + "rdfs:domain :A . :A a owl:Class .",
    "declared in RDFS": _P + "rdfs:domain :A . :A a rdfs:Class .",
    "a declared datatype": ":p a owl:DatatypeProperty ; rdfs:range :D . :D a rdfs:Datatype .",
    "built in": _P + "rdfs:domain owl:Thing . :q a owl:DatatypeProperty ; rdfs:range xsd:string .",
    "a literal and a broken list": ':A a owl:Class ; rdfs:subClassOf "x" ; owl:unionOf :l . '
    ":l rdf:first :A ; rdf:rest :l .",
    "members of another list": "[] a owl:AllDifferent ; owl:members ( :i :j ) .",
}
STRICT = {
    "the words of rules, by OOPS!": (
        "@prefix swrl: <http://www.w3.org/2003/11/swrl#> . :x a swrl:Variable .",
        [("Variable",)],
    ),
    "a domain of which nothing is stated, by OOPS!": (_P + "rdfs:domain :X .", [("X",)]),
    "a domain with a label, by OOPS!": (_P + 'rdfs:domain :X . :X rdfs:label "x" .', []),
    "a type with a label, by OOPS!": (':i a :X . :X rdfs:label "x" .', [("X",)]),
    "a filler, by OOPS!": (_SOME + "owl:someValuesFrom :X ] .", []),
    "made of others, by OOPS!": (
        ":A a owl:Class ; owl:equivalentClass :X . :X owl:unionOf ( :A ) .",
        [],
    ),
    "a declared class, by OOPS!": (_P + "rdfs:domain :A . :A a owl:Class .", []),
}
