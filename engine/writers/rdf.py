"""Environment maps as RDF: GeoSPARQL geometries, SOSA observations, PROV-O lineage.

``ontology/map.ttl`` tells the model. Statements are written as they arise, so memory does not
grow with the map. In N-Quads a map has four named graphs below its base: ``provenance`` (what was
done with what), ``landmarks`` (landmarks and their observations), ``segments`` (segments, their
classifications and reasons) and ``terms`` (the environments and features that occur). Turtle has
the same statements without graphs.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from typing import BinaryIO

import numpy as np

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers.content import Content
from symboslam.engine.writers.options import WriteOptions
from symboslam.engine.writers.rdf_lineage import provenance, terms
from symboslam.engine.writers.rdf_records import Records
from symboslam.engine.writers.rdf_syntax import ABSOLUTE_IRI, NQuads, Syntax, Turtle
from symboslam.engine.writers.vocabulary import MAPS, NAMESPACES
from symboslam.errors import InputError

_KINDS = ("landmark", "observation", "segment", "classification", "agent")


def write_turtle(environment_map: EnvironmentMap, stream: BinaryIO, options: WriteOptions) -> None:
    """Write a map as Turtle.

    Args:
        environment_map: the map.
        stream: where to write, as UTF-8.
        options: ``reasons``, ``progress``, ``base`` and ``ended`` are used.

    Raises:
        InputError: ``base`` is no absolute IRI.
    """
    _write(environment_map, stream, options, Turtle)


def write_nquads(environment_map: EnvironmentMap, stream: BinaryIO, options: WriteOptions) -> None:
    """Write a map as N-Quads; arguments and errors as for ``write_turtle``."""
    _write(environment_map, stream, options, NQuads)


def _write(
    environment_map: EnvironmentMap,
    stream: BinaryIO,
    options: WriteOptions,
    make_syntax: Callable[[str, dict[str, str]], Syntax],
) -> None:
    base = base_of(environment_map, options.base)
    prefixes = {**NAMESPACES, "map": base, **{kind: f"{base}{kind}/" for kind in _KINDS}}
    syntax = make_syntax(base, prefixes)
    records = Records(Content(environment_map, options.reasons), syntax)
    stream.write(syntax.head().encode())
    for graph, described in (
        ("provenance", provenance(records, options.ended)),
        ("landmarks", records.landmarks()),
        ("segments", records.segments(options)),
        ("terms", terms(records)),  # last: only now it is known which features have a say
    ):
        name = syntax.own(graph)
        for subject, properties in described:
            stream.write(syntax.statements(name, subject, properties).encode())


def base_of(environment_map: EnvironmentMap, base: str | None = None) -> str:
    """The IRI below which a map's own IRIs lie, ending in ``/``, ``#`` or ``:``.

    Args:
        environment_map: the map.
        base: what the user wants; None derives it from the content.

    Raises:
        InputError: ``base`` is no absolute IRI.
    """
    if base is None:
        return f"{MAPS}{_fingerprint(environment_map)}/"
    if not ABSOLUTE_IRI.fullmatch(base):
        raise InputError(f"{base!r} is no absolute IRI, such as https://example.org/maps/1/")
    return base if base[-1] in "/#:" else base + "/"


def _fingerprint(m: EnvironmentMap) -> str:
    """Equal for maps of the same landmarks, knowledge, settings and result."""
    found = hashlib.sha256(m.knowledge.source_hash.encode())
    found.update(json.dumps(dict(m.config), sort_keys=True, default=str).encode())
    marks = m.landmarks
    found.update(repr((marks.bbox, marks.frame, len(marks), len(m))).encode())
    columns = (marks.feature, marks.x, marks.y, marks.confidence, marks.id, m.segment_id, m.label)
    for column in columns:
        found.update(np.ascontiguousarray(column).tobytes())
    return found.hexdigest()[:16]
