"""Check an ontology: is it consistent, complete, and does the table agree with the reasoner?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.errors import EmptyOntologyError, InconsistentOntologyError, OntologyError
from symboslam.reasoning import sources as files
from symboslam.reasoning import vocabulary as v

if TYPE_CHECKING:
    from symboslam.reasoning.classes import Classes
    from symboslam.reasoning.knowledge import Knowledge

_PROBE = "urn:symboslam:check:"  # classes that a check adds for the reasoner to fill


@dataclass(frozen=True)
class Finding:
    """Something in an ontology that should be looked at.

    Attributes:
        kind: which check found it, such as ``missing-reason``.
        subject: name of the class or tag that it is about.
        message: what is wrong, in words.
    """

    kind: str
    subject: str
    message: str


@dataclass(frozen=True)
class Report:
    """The result of a check.

    Attributes:
        source: the ontology.
        classes: number of named classes.
        environments: number of environment types.
        features: number of features that landmarks can have.
        indications: number of stated indications.
        ways: number of (feature, environment) pairs with proximity above 0.
        consistent: False if the ontology as a whole contradicts itself.
        unsatisfiable: IRIs of classes that can have no members.
        clash: the axioms that clash, in words.
        findings: everything that should be looked at; a clash is among them.
    """

    source: str
    classes: int = 0
    environments: int = 0
    features: int = 0
    indications: int = 0
    ways: int = 0
    consistent: bool = True
    unsatisfiable: tuple[str, ...] = ()
    clash: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether nothing was found."""
        return not self.findings

    def __str__(self) -> str:
        lines = [
            self.source,
            f"{self.classes} classes, {self.environments} environments, {self.features} features, "
            f"{self.indications} stated indications, {self.ways} feature-environment pairs",
        ]
        if self.clash:
            lines += ["these axioms clash:", *(f"  {axiom}" for axiom in self.clash)]
        else:
            lines.append("consistent, and every class can have members")
        lines.append(
            f"{len(self.findings) or 'no'} finding{'' if len(self.findings) == 1 else 's'}"
        )
        lines += (f"  {f.kind}: {f.subject}: {f.message}" for f in self.findings)
        return "\n".join(lines)


def check_ontology(paths: Sequence[str | Path] | str | Path | None = None) -> Report:
    """Reason over an ontology and look for gaps; nothing is cached.

    Args:
        paths: the file or files of an ontology; None for the bundled one with all its modules.

    Raises:
        InputError: a file cannot be read.
        OntologySyntaxError: a file does not parse.
        OntologyError: the ontology is outside OWL 2 DL.
        ReasonerError: there is no Java, or HermiT failed.
    """
    from symboslam.reasoning.extract import extract
    from symboslam.reasoning.loading import reason
    from symboslam.reasoning.statements import Statements

    if paths is None:
        source, read = "bundled", files.read_closure([files.CLOSURE])
    else:
        given = [paths] if isinstance(paths, str | Path) else list(paths)
        source, read = ", ".join(map(str, given)), files.read_files([Path(p) for p in given])
    stated = Statements(read.graph)
    counts = Report(source, classes=len(stated.classes), indications=len(stated.indications))
    found = [Finding(note.kind, note.subject, note.message) for note in read.notes]
    try:
        classes = reason(read)
    except InconsistentOntologyError as error:
        found.append(Finding("clash", source, str(error).partition("\n")[0]))
        return replace(
            counts,
            consistent=bool(error.classes),
            unsatisfiable=error.classes,
            clash=error.axioms,
            findings=tuple(found),
        )
    found += _in_statements(classes)
    try:
        knowledge = extract(classes)
    except EmptyOntologyError as error:
        found.append(Finding("empty", source, str(error)))
        return replace(counts, environments=len(classes.environments), findings=tuple(found))
    except OntologyError as error:
        if not any(finding.kind == "bad-strength" for finding in found):
            found.append(Finding("bad-value", source, str(error)))
        return replace(counts, findings=tuple(found))
    found += [*_in_table(knowledge), *_disagreements(classes, knowledge, read)]
    return replace(
        counts,
        environments=len(knowledge.environments),
        features=len(knowledge.features),
        ways=len(knowledge.indications),
        findings=tuple(found),
    )


def _in_statements(classes: Classes) -> Iterator[Finding]:
    """Gaps in what the ontology states."""
    from rdflib import RDF, URIRef

    from symboslam.reasoning.extract import is_colour

    stated = classes.stated
    for way in stated.indications:
        name, place = v.local_name(way.feature), v.local_name(way.place)
        words = f"{name} indicates {place}"
        if not way.is_valid:
            numbers = ", ".join(f"{s:g}" for s in way.strengths)
            yield Finding("bad-strength", name, f"{words}: strength {numbers} is not in (0, 1]")
        if len(way.strengths) != 1:
            problem = "has several strengths" if way.strengths else "has no strength (1 is used)"
            yield Finding("missing-strength", name, f"{words}: {problem}")
        if not way.reason:
            yield Finding("missing-reason", name, f"{words}: has no reason (rdfs:comment)")
        if not way.source:
            yield Finding("missing-source", name, f"{words}: has no source (prov:wasDerivedFrom)")
        if not set(classes.places.ways_up(classes.one(way.place))) & set(classes.environments):
            yield Finding("leads-nowhere", name, f"{words}, which belongs to no environment")
    for name in stated.classes:
        if name not in classes.views and stated.defined_by_indicating(name):
            problem = "indicates by definition; state it as rdfs:subClassOf to give it a strength"
            yield Finding("indication-in-definition", v.local_name(name), problem)
    for name in classes.environments:
        for colour in stated.texts(name, v.COLOUR):
            if not is_colour(colour):
                problem = f"the colour {colour!r} is not #rrggbb"
                yield Finding("bad-colour", v.local_name(name), problem)
    if len(classes.environments) == 1:
        name = v.local_name(classes.environments[0])
        yield Finding("one-environment", name, "is the only environment; there is nothing to tell")
    graph = stated.graph
    terms = {t for triple in graph for t in triple if isinstance(t, URIRef) and t.startswith(v.SL)}
    for term in sorted(terms):
        if (term, RDF.type, None) not in graph:
            name = v.local_name(term)
            yield Finding("unknown-term", name, f"sl:{name} is used, but nothing declares it")


def _in_table(knowledge: Knowledge) -> Iterator[Finding]:
    """Gaps in the table."""
    pointing = {way.feature for way in knowledge.indications}
    indicated = {way.environment for way in knowledge.indications}
    claims: dict[tuple[str, str], list[str]] = {}
    for feature in knowledge.features:
        if feature.name not in pointing:
            problem = "indicates no environment"
            yield Finding("feature-without-indication", feature.name, problem)
        if not {"StaticFeature", "DynamicFeature"} & set(feature.kinds):
            problem = "is neither static nor dynamic (static is assumed)"
            yield Finding("neither-static-nor-dynamic", feature.name, problem)
        if feature.detector_label:
            label = feature.detector_label.casefold()
            claims.setdefault(("detector label", label), []).append(feature.name)
        for tag in feature.osm_tags:
            claims.setdefault(("OSM tag", tag), []).append(feature.name)
            key, _, value = tag.partition("=")
            if not key or not value:
                problem = f"the OSM tag {tag!r} is not key=value"
                yield Finding("bad-osm-tag", feature.name, problem)
        if "://" in feature.name:
            problem = "its local name is that of another class too, so the whole IRI is its name"
            yield Finding("shared-name", feature.name, problem)
    for (kind, claimed), claimants in sorted(claims.items()):
        if len(claimants) > 1:
            problem = f"the {kind} {claimed!r} is claimed by {', '.join(claimants)}"
            yield Finding("claimed-twice", claimed, problem)
    for environment in knowledge.environments:
        if environment.name not in indicated:
            problem = "no feature indicates it"
            yield Finding("environment-without-indication", environment.name, problem)


def _disagreements(
    classes: Classes, knowledge: Knowledge, read: files.Sources
) -> Iterator[Finding]:
    """Where HermiT infers another set of features for an environment than the table has.

    For each environment e the reasoner fills the class ``Feature and indicates some e``; the table
    must have a proximity above 0 for exactly its subclasses.
    """
    from rdflib import OWL, RDF, BNode, Graph, URIRef
    from rdflib.collection import Collection

    from symboslam.reasoning.loading import reason

    graph = Graph()
    graph += read.graph
    for environment in knowledge.environments:
        probe, both, way = URIRef(_PROBE + environment.iri), BNode(), BNode()
        graph.add((probe, RDF.type, OWL.Class))
        graph.add((probe, OWL.equivalentClass, both))
        graph.add((both, RDF.type, OWL.Class))
        graph.add((both, OWL.intersectionOf, members := BNode()))
        Collection(graph, members, [URIRef(v.FEATURE), way])
        graph.add((way, RDF.type, OWL.Restriction))
        graph.add((way, OWL.onProperty, URIRef(v.INDICATES)))
        graph.add((way, OWL.someValuesFrom, URIRef(environment.iri)))
    hierarchy = reason(files.Sources(graph)).hierarchy
    pairs = {(way.feature, way.environment) for way in knowledge.indications}
    for feature in knowledge.features:
        above = hierarchy.above(feature.iri)
        for environment in knowledge.environments:
            inferred = _PROBE + environment.iri in above
            if inferred != ((feature.name, environment.name) in pairs):
                words = f"{feature.name} indicates {environment.name}"
                problem = (
                    f"HermiT infers that {words}, but no stated indication leads there"
                    if inferred
                    else f"the table says that {words}, but HermiT does not infer it"
                )
                yield Finding("disagreement", feature.name, problem)
