"""Write what a reasoner concludes of the detector's classes: detector_environments.py [FILE].

The file is the golden one of ``tests/ontology/test_proofs.py``. Run this after a change that is
meant to change the conclusions, and read the difference line by line before you commit it.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from symboslam.reasoning import vocabulary as v
from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit
from symboslam.reasoning.sources import CLOSURE, read_closure

GOLDEN = Path(__file__).parents[1] / "tests/ontology/resources/detector-environments.json"


def conclusions() -> dict[str, list[str]]:
    """Detector label -> the inferred classes, such as ``ResidentialFeature``, that it is below."""
    from rdflib import RDF, RDFS, URIRef

    graph = read_closure([CLOSURE]).graph
    declared, axioms = split(graph)
    hierarchy = Hermit().classify([*declared, *(t for axiom in axioms for t in axiom.triples)])
    if hierarchy is None or hierarchy.unsatisfiable:
        raise SystemExit("The ontology is not sound: run 'symboslam ontology check'.")
    types = {
        c for c in graph.subjects(RDFS.subClassOf, URIRef(v.ENVIRONMENT)) if isinstance(c, URIRef)
    }
    views = {f"{environment}Feature" for environment in types}
    assert all((URIRef(view), RDF.type, None) in graph for view in views)
    labels = {str(o): str(s) for s, o in graph.subject_objects(URIRef(v.DETECTOR_LABEL))}
    return {
        label: sorted(v.local_name(view) for view in views & hierarchy.above(feature))
        for label, feature in sorted(labels.items())
    }


def main() -> None:
    """Write the file."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else GOLDEN
    found = conclusions()
    rows = [f"  {json.dumps(label)}: {json.dumps(views)}" for label, views in found.items()]
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("{\n" + ",\n".join(rows) + "\n}\n", encoding="utf-8")
    print(f"wrote {target}: {len(found)} classes")


if __name__ == "__main__":
    main()
