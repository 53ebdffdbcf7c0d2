"""Maps that are kept: their records, the statements about them, and their addresses."""
