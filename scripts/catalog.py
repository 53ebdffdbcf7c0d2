"""Write the catalogs of ``ontology/``: which file holds which document, for Protégé and ROBOT.

There is one in each folder, because tools look for it beside the file that they open, and not every
tool follows a catalog that leads to another.
"""

from __future__ import annotations

from os.path import relpath
from pathlib import Path

ONTOLOGY = Path(__file__).resolve().parents[1] / "ontology"
DOCUMENTS = "https://w3id.org/symboslam/"
FOLDERS = (".", "alignments", "examples", "shapes", "upstream")
NAME = "catalog-v001.xml"


def catalog(folder: Path, files: list[Path]) -> str:
    """The catalog of a folder, with paths relative to it."""
    lines = (
        f'    <uri name="{DOCUMENTS}{file.relative_to(ONTOLOGY).with_suffix("").as_posix()}"'
        f' uri="{Path(relpath(file, folder)).as_posix()}"/>\n'
        for file in files
    )
    return (
        '<?xml version="1.0" encoding="UTF-8" standalone="no"?>\n'
        '<catalog prefer="public" xmlns="urn:oasis:names:tc:entity:xmlns:xml:catalog">\n'
        f"{''.join(lines)}</catalog>\n"
    )


def main() -> None:
    """Write all of them."""
    folders = [ONTOLOGY / folder for folder in FOLDERS]
    files = [file for folder in folders for file in sorted(folder.glob("*.ttl"))]
    for folder in folders:
        (folder / NAME).write_text(catalog(folder, files), encoding="utf-8")


if __name__ == "__main__":
    main()
