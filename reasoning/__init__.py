"""Reasoning: from OWL files to the small table of knowledge that the engine works with."""
