"""Write the class counts of real zones for worlds: class_frequencies.py COUNTS [OUT].

COUNTS is a CSV of OpenStreetMap tags by zone: columns key, value and one for each environment; the
first row, ``(zone area km2)``, holds the area in which the rest was counted. Tags become detector
classes by the ontology's tags and tree of classes; what it indicates is not looked at.

``building=yes`` means that nobody told the kind of building, not that it has none. Such buildings
are shared out among the classes in proportion to the buildings of the same zone whose kind is told,
and stay buildings where fewer than LEAST_TOLD are.
"""

from __future__ import annotations

import csv
import io
import sys
from collections import Counter, defaultdict
from pathlib import Path

from symboslam.reasoning.knowledge import Feature, Knowledge
from symboslam.sim_bridge.worlds.stand_ins import stand_in

OUT = Path(__file__).parents[1] / "sim_bridge/worlds/class_frequencies.csv"
LEAST_TOLD = 10
SITES = {
    "(school)": "building=school amenity=school amenity=kindergarten",
    "(restaurant)": "amenity=restaurant amenity=cafe amenity=fast_food amenity=pub amenity=bar",
    "(stadium)": "building=stadium",
}
HEAD = """\
# Made by scripts/class_frequencies.py; do not edit.
# Counts of OpenStreetMap objects by zone type in Liechtenstein, Helsinki, Monaco and Prattville,
# zones after the ACT Territory Plan; (c) OpenStreetMap contributors, ODbL 1.0.
# Tags were turned into the 56 detector classes; first row: square kilometres that were counted.
# building=yes is shared out in proportion to the buildings of the zone whose kind is told (if 10 or
# more are). Rows in brackets are no classes: what else stands or walks there is told by companions.
"""


def feature_of(tag: str, features: tuple[Feature, ...]) -> Feature | None:
    """The feature with that tag, else the one with any value of its key; detector classes first."""
    any_value = f"{tag.partition('=')[0]}=*"
    having = [f for f in features if tag in f.osm_tags]
    having = having or [f for f in features if any_value in f.osm_tags]
    return next((f for f in having if f.detector_label), next(iter(having), None))


def table(counts: str, features: tuple[Feature, ...]) -> tuple[str, list[str]]:
    """The text of the table, and the tags of which a robot sees nothing."""
    rows = list(csv.reader(io.StringIO(counts)))
    environments, areas = rows[0][2:], rows[1][2:]
    if rows[1][0] != "(zone area km2)":
        raise SystemExit("the first row must be the area: (zone area km2)")
    found: dict[str, Counter[str]] = defaultdict(Counter)
    tags: dict[str, list[str]] = defaultdict(list)
    told: dict[str, Counter[str]] = defaultdict(Counter)
    untold: Counter[str] = Counter()
    unseen = []
    for key, value, *numbers in rows[2:]:
        number = Counter({e: int(n) for e, n in zip(environments, numbers, strict=True)})
        for site, site_tags in SITES.items():
            if f"{key}={value}" in site_tags.split():
                found[site].update(number)
                tags[site].append(f"{key}={value}")
        if (key, value) == ("building", "yes"):
            untold = number
            continue
        feature = feature_of(f"{key}={value}", features)
        name = stand_in(feature) if feature else None
        if name is None:
            unseen.append(f"{key}={value}")
            continue
        tags[name].append(f"{key}={value}")
        found[name].update(number)
        if key == "building":
            told[name].update(number)
    for environment, total in untold.items():
        for name, number_told in shared(total, {n: row[environment] for n, row in told.items()}):
            found[name][environment] += number_told
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["class", *environments, "tags"])
    writer.writerow(["(km2)", *areas, ""])
    for name in sorted(found):
        writer.writerow([name, *(found[name][e] for e in environments), " ".join(tags[name])])
    return HEAD + out.getvalue(), unseen


def shared(total: int, weights: dict[str, int]) -> list[tuple[str, int]]:
    """A whole number shared out by weights, by remainders; all to Building if these are few."""
    whole = sum(weights.values())
    if whole < LEAST_TOLD:
        return [("Building", total)]
    exact = {name: total * weight / whole for name, weight in weights.items()}
    parts = {name: int(value) for name, value in exact.items()}
    by_remainder = sorted(exact, key=lambda name: (parts[name] - exact[name], name))
    for name in by_remainder[: total - sum(parts.values())]:
        parts[name] += 1
    return list(parts.items())


def main() -> None:
    """Write the table."""
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    target = Path(sys.argv[2]) if len(sys.argv) > 2 else OUT
    counts = Path(sys.argv[1]).read_text(encoding="utf-8")
    text, unseen = table(counts, Knowledge.load().features)
    target.write_text(text, encoding="utf-8", newline="\n")
    print(f"wrote {target}; a robot sees nothing of: {', '.join(unseen)}")


if __name__ == "__main__":
    main()
