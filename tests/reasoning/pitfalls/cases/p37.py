"""P37: nothing is found at the ontology's IRI; test_online.py has the cases."""

POSITIVE: dict[str, tuple[str, list[tuple[str, ...]]]] = {}
NEGATIVE: dict[str, str] = {}
