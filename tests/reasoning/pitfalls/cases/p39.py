"""P39: the IRIs of the ontology depend on where its file is."""

POSITIVE = {
    "a class": ("<#A> a owl:Class .", [()]),
    "a superclass": (":A a owl:Class ; rdfs:subClassOf <B> .", [()]),
    "a predicate": (":A a owl:Class ; <#p> :A .", [()]),
    "a prefix": ("@prefix r: <#> . r:A a owl:Class . r:B a owl:Class .", [()]),
    "the ontology": ("<> a owl:Ontology .", [()]),
    "a file": ("<file:///home/me/a.owl#A> a owl:Class .", [()]),
    "many": (
        "<#A> a owl:Class . <#B> a owl:Class . <#C> a owl:Class . <#D> a owl:Class . "
        "<#E> a owl:Class .",
        [()],
    ),
}
NEGATIVE = {
    "absolute": ":A a owl:Class .",
    "with a base": "@base <https://example.org/o> . <#A> a owl:Class .",
    "a link": ":A a owl:Class ; rdfs:seeAlso <readme.html> ; dcterms:source <book.pdf> .",
    "a name": "<urn:x:A> a owl:Class .",
}
STRICT = {
    "with a full stop, by OOPS!": (":A a owl:Class .", [()]),
    "with a semicolon, by OOPS!": (
        '<https://example.org/b> a owl:Ontology ; rdfs:label "b" . <#A> a owl:Class .',
        [],
    ),
}
