"""P04: unconnected terms."""

RESTRICTION = "[ a owl:Restriction ; owl:onProperty :p ; "

RULE = (
    "@prefix swrl: <http://www.w3.org/2003/11/swrl#> . :x a swrl:Variable . "
    "[] a swrl:Imp ; swrl:body [ a swrl:AtomList ; rdf:rest () ; rdf:first "
    "[ a swrl:ClassAtom ; swrl:classPredicate :A ; swrl:argument1 :x ] ] ; "
    "swrl:head [ a swrl:AtomList ; rdf:rest () ; rdf:first [ a swrl:IndividualPropertyAtom ; "
    "swrl:propertyPredicate :p ; swrl:argument1 :x ; swrl:argument2 :x ] ] . "
)

POSITIVE = {
    "a class": (":A a owl:Class .", [("A",)]),
    "annotations relate nothing": (
        ":A a owl:Class ; rdfs:seeAlso :B . :B a owl:Class ; :n :A . "
        ":n a owl:AnnotationProperty .", [("A",), ("B",)]),
    "below owl:Thing": (":A a owl:Class ; rdfs:subClassOf owl:Thing .", [("A",)]),
    "below itself": (":A a owl:Class ; rdfs:subClassOf :A .", [("A",)]),
    "equivalent, and both alone": (
        ":A a owl:Class ; owl:equivalentClass :B . :B a owl:Class .", [("A",), ("B",)]),
    "defined here": (
        ":A a owl:Class ; rdfs:isDefinedBy <https://example.org/o#> .", [("A",)]),
    "an object property": (":p a owl:ObjectProperty .", [("p",)]),
    "a datatype property with a datatype": (
        ":d a owl:DatatypeProperty ; rdfs:range xsd:string .", [("d",)]),
}  # fmt: skip
NEGATIVE = {
    "a hierarchy, its top included": ":B a owl:Class ; rdfs:subClassOf :A . :A a owl:Class .",
    "below a class of another vocabulary":
        ":A a owl:Class ; rdfs:subClassOf <https://example.com/v#B> .",
    "disjoint": ":A a owl:Class ; owl:disjointWith :B . :B a owl:Class .",
    "all disjoint": "[] a owl:AllDisjointClasses ; owl:members (:A :B) . "
        ":A a owl:Class . :B a owl:Class .",
    "in a restriction": ":A a owl:Class . :B a owl:Class ; rdfs:subClassOf "
        f"{RESTRICTION} owl:someValuesFrom :A ] . :p a owl:ObjectProperty .",
    "in a cardinality": ":A a owl:Class . :B a owl:Class ; rdfs:subClassOf "
        f"{RESTRICTION} owl:onClass :A ; owl:minQualifiedCardinality 1 ] . "
        ":p a owl:ObjectProperty .",
    "in a union": ":A a owl:Class . :B a owl:Class ; owl:disjointUnionOf (:A :C) . "
        ":C a owl:Class .",
    "equivalent to one that is related": ":A a owl:Class ; owl:equivalentClass :B . "
        ":B a owl:Class ; owl:equivalentClass :C . :C a owl:Class ; rdfs:subClassOf :D . "
        ":D a owl:Class .",
    "defined": f":A a owl:Class ; owl:equivalentClass {RESTRICTION} owl:hasValue :x ] . "
        ":p a owl:ObjectProperty .",
    "with an individual": ":A a owl:Class . :x a :A .",
    "with a key": ":A a owl:Class ; owl:hasKey (:d) . :d a owl:DatatypeProperty .",
    "a domain and a range": ":p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :B . "
        ":A a owl:Class . :B a owl:Class .",
    "deprecated": ":A a owl:Class ; owl:deprecated true .",
    "defined elsewhere": ":A a owl:Class ; rdfs:isDefinedBy <https://example.org/v> .",
    "a match of SKOS": ":A a owl:Class ; skos:closeMatch <https://example.org/v#B> .",
    "inverses": ":p a owl:ObjectProperty ; owl:inverseOf :q . :q a owl:ObjectProperty .",
    "a chain": ":p a owl:ObjectProperty ; owl:propertyChainAxiom (:q :r) . "
        ":q a owl:ObjectProperty . :r a owl:ObjectProperty .",
    "used": ':d a owl:DatatypeProperty . <https://example.org/x> :d "1" .',
    "in a rule": RULE + ":A a owl:Class . :p a owl:ObjectProperty .",
    "a negative assertion": ":p a owl:ObjectProperty . [] a owl:NegativePropertyAssertion ; "
        "owl:sourceIndividual :x ; owl:assertionProperty :p ; owl:targetIndividual :y .",
}  # fmt: skip
STRICT = {
    "the top of a hierarchy": (
        ":B a owl:Class ; rdfs:subClassOf :A . :A a owl:Class .", [("A",)]),
    "disjointness relates nothing": (
        ":A a owl:Class ; owl:disjointWith :B . :B a owl:Class .", [("A",), ("B",)]),
    "individuals relate nothing": (":A a owl:Class . :x a :A .", [("A",)]),
    "properties are left out": (":p a owl:ObjectProperty .", []),
    "expressions relate": (
        ":B a owl:Class ; rdfs:subClassOf [ a owl:Class ; owl:intersectionOf (:A "
        "[ a owl:Class ; owl:complementOf :C ] "
        f"{RESTRICTION} owl:someValuesFrom [ a owl:Class ; owl:unionOf (:D :E) ] ] ) ] . "
        ":p a owl:ObjectProperty . :A a owl:Class . :C a owl:Class . :D a owl:Class . "
        ":E a owl:Class .", []),
    "a cardinality relates nothing, nor does an undeclared property": (
        ":p a owl:ObjectProperty . :A a owl:Class . :C a owl:Class . :B a owl:Class ; "
        f"rdfs:subClassOf {RESTRICTION} owl:onClass :A ; owl:minQualifiedCardinality 1 ] , "
        "[ a owl:Restriction ; owl:onProperty :q ; owl:allValuesFrom :C ] .",
        [("A",), ("C",)]),
    "a domain that is a union": (
        ":d a owl:DatatypeProperty ; rdfs:domain [ a owl:Class ; owl:unionOf (:A :B) ] . "
        ":A a owl:Class . :B a owl:Class . :C a owl:Class ; owl:equivalentClass :B .", []),
    "an anonymous subclass": (
        ":A a owl:Class . [ a owl:Class ; owl:unionOf (:B :C) ] rdfs:subClassOf :A .", []),
    "equivalent to what is related": (
        ":B a owl:Class ; rdfs:subClassOf :D ; owl:equivalentClass :A . :A a owl:Class .", []),
}  # fmt: skip
