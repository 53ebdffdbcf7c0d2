"""The query page: a form of our own, with YASGUI's editor and table where they were built in."""
