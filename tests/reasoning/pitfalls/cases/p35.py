"""P35: what is used as a property is not declared as one."""

_A = ":A a owl:Class . "
_Q = ":q a owl:ObjectProperty . "

_RULE = (
    "@prefix swrl: <http://www.w3.org/2003/11/swrl#> . :x a swrl:Variable . "
    "[] a swrl:Imp ; swrl:body [ a swrl:AtomList ; rdf:rest () ; rdf:first "
    "[ a swrl:ClassAtom ; swrl:classPredicate :A ; swrl:argument1 :x ] ] ; "
    "swrl:head [ a swrl:AtomList ; rdf:rest () ; rdf:first [ a swrl:IndividualPropertyAtom ; "
    "swrl:propertyPredicate :p ; swrl:argument1 :x ; swrl:argument2 :x ] ] . "
)

POSITIVE = {
    "a domain": (_A + ":p rdfs:domain :A .", [("p",)]),
    "a range": (_A + ":p rdfs:range :A .", [("p",)]),
    "above": (_Q + ":q rdfs:subPropertyOf :p .", [("p",)]),
    "below": (_Q + ":p rdfs:subPropertyOf :q .", [("p",)]),
    "equivalent": (_Q + ":q owl:equivalentProperty :p .", [("p",)]),
    "disjoint": (_Q + ":p owl:propertyDisjointWith :q .", [("p",)]),
    "inverse": (_Q + ":q owl:inverseOf :p .", [("p",)]),
    "in a restriction": (
        ":A a owl:Class ; rdfs:subClassOf "
        "[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :A ] .",
        [("p",)],
    ),
    "in a chain": (_Q + ":q owl:propertyChainAxiom ( :p :q ) .", [("p",)]),
    "in a list of disjoint properties": (
        _Q + "[] a owl:AllDisjointProperties ; owl:members ( :q :p ) .",
        [("p",)],
    ),
    "a predicate of our own": (_A + ":i a :A ; :p :i .", [("p",)]),
    "in a rule": (_A + _RULE, [("p",)]),
}
NEGATIVE = {
    "a rule": _RULE + ":A a owl:Class . :p a owl:ObjectProperty .",
    "declared": _Q + _A + ":q rdfs:domain :A .",
    "declared in RDF": _A + ":p a rdf:Property ; rdfs:domain :A .",
    "an annotation property": _A + ':p a owl:AnnotationProperty . :A :p "x" .',
    "built in": _Q + ":q rdfs:subPropertyOf owl:topObjectProperty .",
    "a predicate of Dublin Core": _A + ':A dcterms:title "x" .',
    "a literal": _Q + ':q owl:inverseOf "x" .',
}
STRICT = {
    "in a rule, by OOPS!": (_A + _RULE, []),
    "a domain, by OOPS!": (_A + ":p rdfs:domain :A .", [("p",)]),
    "a predicate, by OOPS!": (_A + ":i a :A ; :p :i .", []),
    "in a chain, by OOPS!": (_Q + ":q owl:propertyChainAxiom ( :p :q ) .", []),
    "asymmetric only, by OOPS!": (
        _A + ":p a owl:AsymmetricProperty ; rdfs:domain :A .",
        [("p",)],
    ),
}
