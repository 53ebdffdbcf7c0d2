"""Write pages about the bundled ontology into build/docs: ontology_docs.py [--reasoner] [DIR].

The report on the competency questions goes along; with ``--reasoner`` also for those that need
one, which takes half a minute longer.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from symboslam.reasoning.documentation.site import build_site

ROOT = Path(__file__).resolve().parents[1]


def ask_questions(with_reasoner: bool) -> str | None:
    """The report of ``symboslam cq run`` in HTML; None, and a line that says so, if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.html"
        command = [sys.executable, "-m", "symboslam", "cq", "run", "--format", "html"]
        command += ["--out", str(report)]
        if not with_reasoner:
            command.append("--no-reasoner")
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if report.is_file():  # exit code 1 says that a question failed: the report shows which
            return report.read_text(encoding="utf-8")
    print(f"no competency questions in the pages: {done.stderr.strip()}", file=sys.stderr)
    return None


def main(arguments: list[str]) -> None:
    """Build the pages and say where they are."""
    folders = [argument for argument in arguments if not argument.startswith("-")]
    questions = ask_questions("--reasoner" in arguments)
    out = Path(folders[0]) if folders else ROOT / "build" / "docs"
    first = build_site(questions=questions).write(out)
    print(f"open in a browser: {first}")


if __name__ == "__main__":
    main(sys.argv[1:])
