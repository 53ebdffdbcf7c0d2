"""P40: terms in a namespace of others; test_online.py has the cases."""

POSITIVE: dict[str, tuple[str, list[tuple[str, ...]]]] = {}
NEGATIVE: dict[str, str] = {}
