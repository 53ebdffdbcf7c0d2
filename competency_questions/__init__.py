"""The questions that the ontology must be able to answer: manifests, queries, answers; no code."""
