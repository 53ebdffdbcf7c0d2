"""Justifications as text, JSON and RDF."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from symboslam.reasoning import vocabulary as v

if TYPE_CHECKING:
    from symboslam.reasoning.why import Justifications, StatedAxiom


def as_text(found: Justifications) -> str:
    """For people: each way with its axioms, where they stand and why they hold."""
    said = found.entailment.text
    if not found.entailed:
        return f"{said[:1].upper()}{said[1:]}: that does not follow."
    if not all(found.sets):
        return f"{said[:1].upper()}{said[1:]}: that holds in any ontology."
    only = "the only way" if found.complete else "there may be other ways"
    count = len(found.sets)
    ways = f"{count} ways" if count > 1 else only if found.complete else f"1 way; {only}"
    if count > 1 and not found.complete:
        ways += f"; {only}"
    lines = [f"{said[:1].upper()}{said[1:]}, because of these axioms ({ways}):"]
    for number, axioms in enumerate(found.sets, 1):
        if count > 1:
            lines.append(f" way {number}:")
        for axiom in axioms:
            lines.append(f"  {axiom.text}  [{axiom.place or 'not from a file'}]")
            if axiom.reason or axiom.strength is not None:
                strength = "" if axiom.strength is None else f"strength {axiom.strength:g}:"
                source = f"({axiom.source})" if axiom.source else ""
                lines.append("    " + " ".join(filter(None, (strength, axiom.reason, source))))
    return "\n".join(lines)


def as_json(found: Justifications) -> str:
    """For programs."""
    record = {
        "entailment": {
            "kind": found.entailment.kind,
            "subject": found.entailment.subject,
            "object": found.entailment.object,
            "text": found.entailment.text,
        },
        "entailed": found.entailed,
        "complete": found.complete,
        "justifications": [
            {"axioms": [_axiom_record(axiom) for axiom in axioms]} for axioms in found.sets
        ],
    }
    return json.dumps(record, indent=1, ensure_ascii=False)


def _axiom_record(axiom: StatedAxiom) -> dict[str, Any]:
    from rdflib import URIRef

    inner = axiom.axiom
    return {
        "text": axiom.text,
        "subject": str(inner.subject) if isinstance(inner.subject, URIRef) else None,
        "predicate": str(inner.predicate),
        "object": str(inner.object) if isinstance(inner.object, URIRef) else None,
        "names": sorted(inner.signature),
        "file": axiom.place.file if axiom.place else None,
        "line": axiom.place.line if axiom.place else None,
        "strength": axiom.strength,
        "reason": axiom.reason or None,
        "source": axiom.source or None,
    }


def as_turtle(found: Justifications) -> str:
    """As RDF, in the terms of ``ontology/justification.ttl``.

    Each axiom is annotated as OWL 2 annotates axioms (Mapping to RDF, 2.3), and stated as well, so
    that the axioms of a justification can be taken out and reasoned over.
    """
    from rdflib import OWL, RDF, RDFS, BNode, Graph, Literal, Namespace, URIRef
    from rdflib.namespace import DCTERMS

    sl = Namespace(v.SL)
    graph = Graph()
    for prefix, namespace in (("sl", v.SL), ("owl", OWL), ("dcterms", DCTERMS)):
        graph.bind(prefix, namespace)
    entailment = URIRef("#entailment")
    asked = found.entailment
    graph.add((entailment, RDF.type, sl.Entailment))
    graph.add((entailment, RDFS.label, Literal(asked.text, lang="en")))
    if asked.subject:
        graph.add((entailment, OWL.annotatedSource, URIRef(asked.subject)))
        graph.add((entailment, OWL.annotatedProperty, RDFS.subClassOf))
        target = URIRef(asked.object or OWL.Nothing)
        if asked.kind == "indicates":
            target, filler = BNode(), target  # type: ignore[assignment]
            graph.add((target, RDF.type, OWL.Restriction))
            graph.add((target, OWL.onProperty, URIRef(v.INDICATES)))
            graph.add((target, OWL.someValuesFrom, filler))
        graph.add((entailment, OWL.annotatedTarget, target))
    for number, axioms in enumerate(found.sets, 1):
        justification = URIRef(f"#justification-{number}")
        graph.add((justification, RDF.type, sl.Justification))
        graph.add((justification, sl.justifies, entailment))
        for axiom in axioms:
            inner, note = axiom.axiom, BNode()
            for triple in inner.triples:
                graph.add(triple)
            graph.add((justification, sl.usesAxiom, note))
            graph.add((note, RDF.type, OWL.Axiom))
            graph.add((note, OWL.annotatedSource, inner.subject))
            graph.add((note, OWL.annotatedProperty, inner.predicate))
            graph.add((note, OWL.annotatedTarget, inner.object))
            graph.add((note, RDFS.label, Literal(axiom.text, lang="en")))
            if axiom.place:
                graph.add((note, DCTERMS.source, Literal(axiom.place.file)))
                if axiom.place.line is not None:
                    graph.add((note, sl.lineNumber, Literal(axiom.place.line)))
            if axiom.strength is not None:
                graph.add((note, sl.strength, Literal(axiom.strength)))
            if axiom.reason:
                graph.add((note, RDFS.comment, Literal(axiom.reason, lang="en")))
    return graph.serialize(format="turtle")
