"""What a scan found in the two forms of OOPS!'s web service, for tools that read its answers.

The web service answers in RDF/XML, and its clients (WIDOCO, OnToology, scripts with rdflib) read
that; so ``oops-rdf`` is RDF/XML, with the triples that the present source of OOPS! gives as Turtle.
``oops-xml`` is the older form of the same answer, plain XML.

Neither form has words for what was not looked for, so that a pitfall that is not there was either
not found or not checked. Accepted, known and advisory findings are left out of both: OOPS! knows
none of these, and a tool that counts its pitfalls would count them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple
from uuid import NAMESPACE_URL, uuid5
from xml.etree.ElementTree import Element, SubElement, indent, register_namespace, tostring

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Report, Result

DEF = "http://oops.linkeddata.es/def#"
DATA = "http://oops.linkeddata.es/data/"
OLD = "http://www.oeg-upm.net/oops"
_RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
_XSD = "http://www.w3.org/2001/XMLSchema#"

_WRAPPERS = {
    "notInverseRelationship": "MightNotBeInverseOf",
    "equivalentProperty": "MightBeEquivalentProperty",
    "equivalentAttribute": "MightBeEquivalentAttribute",
    "equivalentClass": "MightBeEquivalentClass",
    "wrongEquivalentClass": "MightNotBeEquivalentClass",
    "sameLabel": "HaveSameLabel",
}
"""Class of a group in RDF -> element around a group in XML."""
_JOINED = ("P06", "P27")
"""Where the old service put the IRIs of a group into one element, with blanks between."""


class _Form(NamedTuple):
    """A pitfall, or a variant of one, as OOPS! sees it."""

    pitfall: Pitfall
    code: str
    title: str
    findings: tuple[Finding, ...]


def render_rdf(report: Report) -> str:
    """The report as OOPS!'s RDF; the same findings give the same text."""
    register_namespace("oops", DEF)
    register_namespace("rdf", _RDF)
    root = Element(f"{{{_RDF}}}RDF")
    response = SubElement(root, f"{{{DEF}}}response")
    names = []
    for form in _forms(report):
        described = _describe(root, form, report.settings.strict_oops)
        names.append(described)
        SubElement(response, f"{{{DEF}}}hasPitfall", {f"{{{_RDF}}}resource": described})
    response.set(f"{{{_RDF}}}about", _name("response", report.ontology, *names))
    return _text(root)


def render_xml(report: Report) -> str:
    """The report as OOPS!'s older XML."""
    register_namespace("oops", OLD)
    root = Element(f"{{{OLD}}}OOPSResponse")
    for result in report.results:
        findings = _findings(result)
        hints = [f for f in findings if f.variant == "P13-S"]
        if pitfalls := [f for f in findings if f.variant != "P13-S"]:
            _old_pitfall(root, result.pitfall, pitfalls, report.settings.strict_oops)
        if hints:
            hint = SubElement(root, f"{{{OLD}}}Suggestion")
            _put(hint, "Name", result.pitfall.variants["P13-S"])
            _put(hint, "Description", result.pitfall.description)
            _put(hint, "NumberAffectedElements", str(len(hints)))
            affects = SubElement(hint, f"{{{OLD}}}Affects")
            _elements(affects, [element for f in hints for element in f.elements])
    return _text(root)


def _text(root: Element) -> str:
    indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{tostring(root, encoding="unicode")}\n'


def _findings(result: Result) -> tuple[Finding, ...]:
    return () if result.pitfall.advisory else tuple(o.finding for o in result.counting)


def _importance(pitfall: Pitfall, strict: bool) -> str:
    severity = pitfall.oops_severity if strict and pitfall.oops_severity else pitfall.severity
    return severity.upper()


# RDF


def _forms(report: Report) -> Iterator[_Form]:
    """What was found by variant; each is a pitfall of its own in OOPS!'s RDF."""
    for result in report.results:
        pitfall, findings = result.pitfall, _findings(result)
        for variant in sorted({finding.variant for finding in findings}):
            yield _Form(
                pitfall,
                variant or pitfall.code,
                pitfall.variants.get(variant, pitfall.title),
                tuple(finding for finding in findings if finding.variant == variant),
            )


def _describe(root: Element, form: _Form, strict: bool) -> str:
    """Add a pitfall and its groups; returns the pitfall's name."""
    affected: dict[str, None] = {}
    groups: dict[str, tuple[str, Finding]] = {}
    for number, finding in enumerate(form.findings):
        group = finding.oops_group or form.pitfall.oops_group
        if group and finding.elements:
            name = _name(group, form.code, str(number), *finding.elements)
            groups[name] = (group, finding)
            affected[name] = None
        else:
            affected.update(dict.fromkeys(map(str, finding.elements)))
    name = _name("pitfall", form.code, str(len(form.findings)), *affected)
    node = SubElement(root, f"{{{DEF}}}pitfall", {f"{{{_RDF}}}about": name})
    _value(node, "hasCode", f"{form.code} - {form.title}")
    _value(node, "hasName", form.title)
    _value(node, "hasDescription", form.pitfall.description)
    _value(node, "hasImportanceLevel", _importance(form.pitfall, strict))
    _value(node, "hasNumberAffectedElements", str(len(form.findings)), "integer")
    for element in affected:
        _value(node, "hasAffectedElement", element, "anyURI")
    for about, (group, finding) in groups.items():
        node = SubElement(root, f"{{{DEF}}}{group}", {f"{{{_RDF}}}about": about})
        for element in dict.fromkeys(finding.elements):
            _value(node, "hasAffectedElement", element, "anyURI")
    return name


def _value(node: Element, name: str, text: str, datatype: str = "") -> None:
    kind = {f"{{{_RDF}}}datatype": _XSD + datatype} if datatype else {}
    SubElement(node, f"{{{DEF}}}{name}", kind).text = text


def _name(*content: str) -> str:
    """A name that depends on the content alone."""
    return f"{DATA}{uuid5(NAMESPACE_URL, DATA + chr(10).join(content))}"


# XML


def _old_pitfall(
    root: Element, pitfall: Pitfall, findings: Sequence[Finding], strict: bool
) -> None:
    node = SubElement(root, f"{{{OLD}}}Pitfall")
    _put(node, "Code", pitfall.code)
    _put(node, "Name", pitfall.title)
    _put(node, "Description", pitfall.description)
    _put(node, "Importance", _importance(pitfall, strict).capitalize())
    # The old service counted properties without an inverse, not pairs of them.
    number = sum(len(f.elements) if f.variant == "P13-Y" else 1 for f in findings)
    _put(node, "NumberAffectedElements", str(number))
    if not any(finding.elements for finding in findings):
        return
    affects = SubElement(node, f"{{{OLD}}}Affects")
    alone: list[str] = []
    for finding in findings:
        group = finding.oops_group or pitfall.oops_group
        if finding.variant == "P13-Y":
            _elements(SubElement(affects, f"{{{OLD}}}MightBeInverse"), finding.elements)
        elif finding.variant == "P13-N":
            alone += finding.elements
        elif pitfall.code in _JOINED:
            _elements(affects, [" ".join(finding.elements)])
        elif group in _WRAPPERS:
            _elements(SubElement(affects, f"{{{OLD}}}{_WRAPPERS[group]}"), finding.elements)
        else:
            _elements(affects, finding.elements)
    if alone:
        _elements(SubElement(affects, f"{{{OLD}}}NoInverseSuggestion"), alone)


def _elements(node: Element, elements: Sequence[str]) -> None:
    for element in elements:
        _put(node, "AffectedElement", element)


def _put(node: Element, name: str, text: str) -> None:
    SubElement(node, f"{{{OLD}}}{name}").text = text
