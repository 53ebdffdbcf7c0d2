"""Worlds for robots: their file format, importers, and a seeded generator of the paper's areas."""
