"""Competency questions: what an ontology must be able to answer, asked and checked by machine."""
