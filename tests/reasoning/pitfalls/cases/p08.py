"""P08: missing labels and comments."""

POSITIVE = {
    "neither": (":A a owl:Class .", [("A",)]),
    "no comment": (':p a owl:ObjectProperty ; rdfs:label "p" .', [("p",)]),
    "no label": (':d a owl:DatatypeProperty ; rdfs:comment "d" .', [("d",)]),
    "empty texts": (':A a owl:Class ; rdfs:label " " ; rdfs:comment "" .', [("A",)]),
}
NEGATIVE = {
    "both": ':A a owl:Class ; rdfs:label "a"@en ; rdfs:comment "An a."@en .',
    "of SKOS": ':A a owl:Class ; skos:prefLabel "a"@en ; skos:definition "An a."@en .',
    "a description": ':A a owl:Class ; rdfs:label "a" ; dcterms:description "An a." .',
    "a definition that is a resource": ':A a owl:Class ; rdfs:label "a" ; skos:definition :text .',
    "OBO's definition": (
        ':A a owl:Class ; rdfs:label "a" ; <http://purl.obolibrary.org/obo/IAO_0000115> "An a." .'
    ),
    "deprecated": ":A a owl:Class ; owl:deprecated true . :B a owl:Class, owl:DeprecatedClass .",
    "an annotation property": ":note a owl:AnnotationProperty .",
}
STRICT = {
    "OOPS! has only rdfs:label": (
        ':A a owl:Class ; skos:prefLabel "a"@en ; skos:definition "An a."@en .',
        [("A",)],
    ),
    "OOPS! takes empty texts": (':A a owl:Class ; rdfs:label "" ; rdfs:comment "" .', []),
    "OOPS! counts deprecated terms": (":A a owl:Class ; owl:deprecated true .", [("A",)]),
}
