"""P32: classes with the same label."""

POSITIVE = {
    "the same": (
        ':A a owl:Class ; rdfs:label "River"@en . :B a owl:Class ; rdfs:label "river"@en .',
        [("A", "B")],
    ),
    "no language": (
        ':A a owl:Class ; rdfs:label "big river" . :B a owl:Class ; skos:prefLabel "Big-River" .',
        [("A", "B")],
    ),
    "any language, three classes": (
        ':A a owl:Class ; rdfs:label "川"@ja . :B a owl:Class ; rdfs:label "川"@ja . '
        ':C a owl:Class ; rdfs:label "川"@JA .',
        [("A", "B", "C")],
    ),
    "two labels, one finding": (
        ':A a owl:Class ; rdfs:label "river"@en, "rio"@pt . '
        ':B a owl:Class ; rdfs:label "river"@en, "rio"@pt .',
        [("A", "B")],
    ),
    "one of three is equivalent to both": (
        ':A a owl:Class ; rdfs:label "a" . :B a owl:Class ; rdfs:label "a" ; '
        'owl:equivalentClass :A . :C a owl:Class ; rdfs:label "a" .',
        [("A", "B", "C")],
    ),
    "regions of one language": (
        ':A a owl:Class ; rdfs:label "Car"@en . :B a owl:Class ; rdfs:label "car"@en-GB .',
        [("A", "B")],
    ),
    "with and without a language": (
        ':A a owl:Class ; rdfs:label "Car"@en . :B a owl:Class ; rdfs:label "Car" .',
        [("A", "B")],
    ),
    "without a language, and two languages": (
        ':A a owl:Class ; rdfs:label "Gift"@en . :B a owl:Class ; rdfs:label "Gift"@de . '
        ':C a owl:Class ; rdfs:label "Gift" .',
        [("A", "B", "C")],
    ),
    "equivalent to the one without a language, in one language of two": (
        ':A a owl:Class ; rdfs:label "Gift"@en . :B a owl:Class ; rdfs:label "Gift"@de . '
        ':C a owl:Class ; rdfs:label "Gift" ; owl:equivalentClass :A .',
        [("B", "C")],
    ),
}
NEGATIVE = {
    "different languages": (
        ':A a owl:Class ; rdfs:label "gift"@en . :B a owl:Class ; rdfs:label "gift"@de .'
    ),
    "a digit differs": (
        ':A a owl:Class ; rdfs:label "Zone 1"@en . :B a owl:Class ; rdfs:label "Zone 2"@en .'
    ),
    "a mark differs": ':A a owl:Class ; rdfs:label "C" . :B a owl:Class ; rdfs:label "C++" .',
    "equivalent": (
        ':A a owl:Class ; rdfs:label "a" ; owl:equivalentClass :X . '
        ':B a owl:Class ; rdfs:label "a" ; owl:equivalentClass :X .'
    ),
    "one class, with and without a language": ':A a owl:Class ; rdfs:label "Car", "Car"@en .',
    "equivalent, with and without a language": (
        ':A a owl:Class ; rdfs:label "a"@en ; owl:equivalentClass :B . '
        ':B a owl:Class ; rdfs:label "a" .'
    ),
    "deprecated": (
        ':A a owl:Class ; rdfs:label "a" . :B a owl:Class ; rdfs:label "a" ; owl:deprecated true .'
    ),
    "a class and a property": ':A a owl:Class ; rdfs:label "a" . :p a owl:ObjectProperty ; '
    'rdfs:label "a" .',
    "empty": ':A a owl:Class ; rdfs:label "" . :B a owl:Class ; rdfs:label "" .',
}
STRICT = {
    "OOPS! drops digits": (
        ':A a owl:Class ; rdfs:label "Zone 1"@en . :B a owl:Class ; rdfs:label "Zone 2"@en .',
        [("A", "B")],
    ),
    "OOPS! needs a language": (
        ':A a owl:Class ; rdfs:label "a" . :B a owl:Class ; rdfs:label "a" .',
        [],
    ),
    "OOPS! needs one of six languages": (
        ':A a owl:Class ; rdfs:label "a"@nl . :B a owl:Class ; rdfs:label "a"@nl .',
        [],
    ),
    "OOPS! knows equivalence": (
        ':A a owl:Class ; rdfs:label "a"@en ; owl:equivalentClass :B . '
        ':B a owl:Class ; rdfs:label "a"@en .',
        [],
    ),
}
