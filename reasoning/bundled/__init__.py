"""The bundled ontology's knowledge, reasoned beforehand: ``knowledge.json``, a generated file."""
