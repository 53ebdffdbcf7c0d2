"""What imports that were not read may declare: nobody knows, and a rule may have to say so."""

from __future__ import annotations

from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import NotCheckedError
from symboslam.reasoning.pitfalls.ontology import Ontology


def not_read(ontology: Ontology) -> NotCheckedError:
    """Why a pitfall cannot be told: the imports that were not read, by name."""
    names = ", ".join(f"<{iri}>" for iri in ontology.unread)
    if len(ontology.unread) == 1:
        return NotCheckedError(f"the import {names} was not read, and what it states is not known")
    return NotCheckedError(f"the imports {names} were not read, and what they state is not known")


def is_of_unread(ontology: Ontology, term: Node) -> bool:
    """Whether the IRI of a term begins as that of an import that was not read."""
    return any(
        str(term).startswith((f"{stem}#", f"{stem}/"))
        for stem in (iri.rstrip("#/") for iri in ontology.unread)
    )
