"""Write the bundled ontology's knowledge: ``python -m symboslam.reasoning.bundle``."""

from __future__ import annotations

import sys

from symboslam.errors import SymboSlamError
from symboslam.reasoning.loading import BUNDLED_FILE, build_bundled
from symboslam.reasoning.store import to_json


def main() -> int:
    """Reason over the bundled ontology and write the shipped file; the exit code."""
    try:
        knowledge, digests = build_bundled()
    except SymboSlamError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_code
    temporary = BUNDLED_FILE.with_suffix(".part")
    temporary.write_text(to_json(knowledge, digests), encoding="utf-8", newline="\n")
    temporary.replace(BUNDLED_FILE)
    sys.stderr.write(f"{BUNDLED_FILE.name}: {knowledge!r}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
