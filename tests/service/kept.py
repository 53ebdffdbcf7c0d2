"""What the store says of a map: is it whole, and is it the same as elsewhere?"""

from __future__ import annotations

from decimal import Decimal

import httpx
import shapely

BASE = "https://w3id.org/symboslam/map/"
GRAPHS = ("landmarks", "segments", "terms", "overrides", "provenance")
_PREFIXES = """
PREFIX sl: <https://w3id.org/symboslam#>
PREFIX geo: <http://www.opengis.net/ont/geosparql#>
PREFIX sosa: <http://www.w3.org/ns/sosa/>
"""
_DECIMAL = "^^<http://www.w3.org/2001/XMLSchema#decimal>"
_CLOSE = Decimal("0.00001")


def _rows(client: httpx.Client, query: str) -> list[dict[str, str]]:
    response = client.post(
        "/sparql", content=_PREFIXES + query,
        headers={"Content-Type": "application/sparql-query", "Accept": "application/json"},
    ).raise_for_status()  # fmt: skip
    bindings = response.json()["results"]["bindings"]
    return [{name: value["value"] for name, value in row.items()} for row in bindings]


def half_written(client: httpx.Client, which: str, side: float = 900.0) -> list[str]:
    """What is not whole in the statements about a square map in metres.

    One query sees all of it, because a service that has just started states what it owes.
    """
    base, found = f"{BASE}{which}/", []
    rows = _rows(client, f"""SELECT * {{
        {{ GRAPH <{base}segments> {{
            ?s a sl:Segment ; sl:landmarkCount ?n ; geo:hasGeometry/geo:asWKT ?wkt
            OPTIONAL {{ ?s sl:environment ?environment }} }} }}
        UNION {{ GRAPH <{base}segments> {{
            ?c sosa:hasFeatureOfInterest ?s ; sosa:hasResult ?d .
            ?d sl:hasProbability/sl:probability ?p }} }}
        UNION {{ SELECT (COUNT(?l) AS ?landmarks) {{
            GRAPH <{base}landmarks> {{ ?l a sl:Landmark }} }} }} }}""")  # fmt: skip
    segments = [row for row in rows if "wkt" in row]
    outlines = [shapely.from_wkt(row["wkt"].rpartition("> ")[2] or row["wkt"]) for row in segments]
    area, union = sum(o.area for o in outlines), shapely.union_all(outlines).area
    if abs(area - side**2) > 1 or abs(union - side**2) > 1:
        found.append(f"segments cover {union} of {side**2} with {area}")
    if len({row["s"] for row in segments}) != len(segments):
        found.append("a segment has two counts, types or outlines")
    here = sum(int(row["landmarks"]) for row in rows if "landmarks" in row)
    counted = sum(int(row["n"]) for row in segments)
    if here != counted:
        found.append(f"{here} landmarks, {counted} in segments")
    sums: dict[str, list[Decimal]] = {}
    distributions: dict[str, set[str]] = {}
    for row in rows:
        if "p" in row:
            sums.setdefault(row["s"], []).append(Decimal(row["p"]))
            distributions.setdefault(row["s"], set()).add(row["d"])
    known = {row["s"] for row in segments if "environment" in row}
    if known != set(sums):
        found.append(f"{len(known)} segments of a type, {len(sums)} classified")
    found += [f"{s}: distributions {d}" for s, d in distributions.items() if len(d) != 1]
    found += [
        f"{s}: sum {sum(p, Decimal(0))}"
        for s, p in sums.items()
        if abs(sum(p, Decimal(-1))) > _CLOSE
    ]
    return found


def graphs_of(client: httpx.Client, which: str) -> dict[str, set[str]]:
    """The lines of all graphs of a map; none of one that is not there."""
    found = {}
    for name in GRAPHS:
        response = client.get(
            "/graphs", params={"graph": f"{BASE}{which}/{name}"},
            headers={"Accept": "application/n-triples"},
        )  # fmt: skip
        found[name] = set(response.text.splitlines()) if response.status_code == 200 else set()
    return found


def same(anew: dict[str, set[str]], kept: dict[str, set[str]]) -> bool:
    """Whether graphs say the same, up to the last digit of a decimal number.

    Args:
        anew: made anew of the records.
        kept: kept up to date; labels that are not needed any more may have stayed.
    """
    kept = {**kept, "terms": kept["terms"] & anew["terms"]}
    return not any(differing(anew[name], kept[name]) for name in GRAPHS)


def differing(one: set[str], two: set[str]) -> list[str]:
    """Lines in one of two sets that have no partner in the other."""
    left, right = sorted(one - two), sorted(two - one)
    for line in list(left):
        for other in right:
            if _close(line, other):
                left.remove(line)
                right.remove(other)
                break
    return [*left, *right]


def _close(one: str, two: str) -> bool:
    a, b = _split(one), _split(two)
    return a is not None and b is not None and a[0] == b[0] and abs(a[1] - b[1]) <= _CLOSE


def _split(line: str) -> tuple[str, Decimal] | None:
    head, _, value = line.removesuffix(" .").rpartition(' "')
    number, _, kind = value.partition('"')
    return (head, Decimal(number)) if kind == _DECIMAL else None
