"""The bundled ontology: OWL modules in Turtle, read as package data."""
