"""Diagrams of an ontology as SVG, laid out without any program outside Python."""
