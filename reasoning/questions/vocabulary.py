"""Every IRI that the competency question code names."""

from __future__ import annotations

from symboslam.reasoning.vocabulary import OWL_NAMESPACE, RDF_NAMESPACE, SL

# OWLunit, the vocabulary of manifests.
OWLUNIT = "https://w3id.org/OWLunit/ontology/"
QUESTION = OWLUNIT + "CompetencyQuestionVerification"
INFERENCE = OWLUNIT + "InferenceVerification"
PROVOCATION = OWLUNIT + "ErrorProvocation"
ANNOTATION = OWLUNIT + "AnnotationVerification"
SUITE = OWLUNIT + "TestSuite"
HAS_TEST_CASE = OWLUNIT + "hasTestCase"
HAS_QUESTION = OWLUNIT + "hasCompetencyQuestion"
HAS_QUERY = OWLUNIT + "hasSPARQLUnitTest"
HAS_EXPECTED = OWLUNIT + "hasExpectedResult"
HAS_DATA = OWLUNIT + "hasInputData"
HAS_SHAPES = OWLUNIT + "hasShapes"
HAS_REASONER = OWLUNIT + "hasReasoner"
HERMIT = OWLUNIT + "HermiT"
TESTS_ONTOLOGY = OWLUNIT + "testsOntology"

# SymboSLAM's additions to it (ontology/testing.ttl).
COMPARES_COLUMN = SL + "comparesColumn"
KNOWN_FAILING = SL + "knownFailing"

KNOWN = (
    HAS_TEST_CASE, HAS_QUESTION, HAS_QUERY, HAS_EXPECTED, HAS_DATA, HAS_SHAPES, HAS_REASONER,
    TESTS_ONTOLOGY, OWLUNIT + "hasInputTestDataCategory", COMPARES_COLUMN, KNOWN_FAILING,
)  # fmt: skip
"""Properties that a manifest may use; what comes close to one is a slip."""

# Entailment regimes of SPARQL 1.1.
ENTAILMENT_REGIME = "http://www.w3.org/ns/sparql-service-description#entailmentRegime"
SIMPLE = "http://www.w3.org/ns/entailment/Simple"
RDFS_REGIME = "http://www.w3.org/ns/entailment/RDFS"
OWL_DIRECT = "http://www.w3.org/ns/entailment/OWL-Direct"

# Terms of others.
DCTERMS = "http://purl.org/dc/terms/"
IDENTIFIER = DCTERMS + "identifier"
SUBJECT = DCTERMS + "subject"
TITLE = DCTERMS + "title"
DESCRIPTION = DCTERMS + "description"
RDFS_NAMESPACE = "http://www.w3.org/2000/01/rdf-schema#"
XSD_NAMESPACE = "http://www.w3.org/2001/XMLSchema#"
TYPE = RDF_NAMESPACE + "type"
LABEL = RDFS_NAMESPACE + "label"
SEE_ALSO = RDFS_NAMESPACE + "seeAlso"
SUBCLASS = RDFS_NAMESPACE + "subClassOf"
SUBPROPERTY = RDFS_NAMESPACE + "subPropertyOf"
DOMAIN = RDFS_NAMESPACE + "domain"
RANGE = RDFS_NAMESPACE + "range"
IMPORTS = OWL_NAMESPACE + "imports"
EQUIVALENT_CLASS = OWL_NAMESPACE + "equivalentClass"
RESULT_SET = "http://www.w3.org/2001/sw/DataAccess/tests/result-set#"

BUILT_IN = (RDF_NAMESPACE, RDFS_NAMESPACE, OWL_NAMESPACE, XSD_NAMESPACE)
"""Vocabularies whose terms every ontology knows."""
