"""Pages about an ontology, for people: reference, diagrams, features of each environment type."""
