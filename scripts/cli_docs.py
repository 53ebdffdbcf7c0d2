"""Write docs/cli.md from the command line's own help: cli_docs.py [FILE]."""

from __future__ import annotations

import html
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
HEAD = "<!-- Made by `make docs` from the commands' own help. Do not edit. -->\n\n"


def main(target: Path) -> None:
    """Ask typer for the pages of all commands, in plain Markdown, and write them."""
    command = "-m typer symboslam.cli.main utils docs --name symboslam".split()
    made = subprocess.run([sys.executable, *command], check=True, capture_output=True, text=True)
    text = re.sub(r'<span style="font-weight: bold">(.*?)</span>', r"**\1**", made.stdout)
    text = re.sub(r"\[bold\](.*?)\[/\]", r"**\1**", text)
    target.write_text(HEAD + html.unescape(text).strip() + "\n", encoding="utf-8")
    print(f"wrote {target}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "cli.md")
