"""Names, tags, schemes and how knowledge shows itself."""

from __future__ import annotations

import numpy as np
import pytest

from symboslam.errors import UnknownNameError
from symboslam.reasoning.knowledge import Environment, Feature, Knowledge
from symboslam.reasoning.matching import TagMatcher, name_index


@pytest.mark.parametrize(
    ("name", "feature"),
    [
        ("house_1", "House"),
        ("HOUSE_1", "House"),
        ("House", "House"),
        (" cottage ", "Cottage"),
        ("https://example.org/town#Tower", "Tower"),
        ("automobile", "Car"),
        ("https://example.org/town#Automobile", "Car"),
        ("country cottage", "Cottage"),
    ],
)
def test_names(town: Knowledge, name: str, feature: str) -> None:
    assert town.get_feature(name).name == feature
    found = town.find_feature(name)
    assert found is not None
    assert found.name == feature


def test_unknown_name(town: Knowledge) -> None:
    assert town.index_of("Castle") is None
    assert town.find_feature("Castle") is None
    with pytest.raises(UnknownNameError, match="no feature 'Cotage'; did you mean Cottage"):
        town.get_feature("Cotage")
    with pytest.raises(UnknownNameError, match="no feature"):
        town.indications_of("Castle")


def test_better_kind_of_name_wins() -> None:
    features = [
        Feature("x:Hall", "Hall", "Tower"),
        Feature("x:Tower", "Tower", "Tower", aliases=("old#Spire",)),
        Feature("x:Mast", "Mast", "Mast", detector_label="Hall"),
    ]
    index = name_index(features)
    assert index == {
        "hall": 2, "tower": 1, "mast": 2, "x:hall": 0, "x:tower": 1, "x:mast": 2, "old#spire": 1,
        "spire": 1,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("tags", "feature"),
    [
        ({"building": "house"}, "House"),
        ({"building": "barn"}, "Tower"),  # building=*
        ({"building": "no"}, None),
        ({"building": ""}, None),
        ({"building": "hut"}, "Cottage"),  # a kind of House, which claims it too
        ({"building": "barn; hut"}, "Cottage"),
        ({"building": "barn;shed"}, "Tower"),
        ({"amenity": "car"}, "Car"),  # the tag is on the equal class Automobile
        ({"amenity": "bench"}, None),
        ({"building": "house", "man_made": "tower"}, "Tower"),  # 1 * 1 beats 0.54 * 0.9
        ({"name": "House"}, None),
        ({}, None),
    ],
)
def test_tags(town: Knowledge, tags: dict[str, str], feature: str | None) -> None:
    index = town.match_tags(tags)
    assert (None if index is None else town.features[index].name) == feature
    assert town.match_tags(tags) == index  # from memory


def test_exact_tag_beats_wildcard_of_the_same_key_only() -> None:
    features = [
        Feature("a", "Building", "", osm_tags=("building=yes",)),
        Feature("b", "Shop", "", osm_tags=("shop=*",)),
        Feature("c", "Bakery", "", osm_tags=("shop=bakery",)),
    ]
    matcher = TagMatcher(features, [0.1, 0.6, 0.5])
    assert matcher.match({"shop": "bakery", "building": "yes"}) == 2
    assert matcher.match({"building": "yes", "shop": "hats"}) == 1


def test_ties_go_to_the_first() -> None:
    features = [Feature(n, n, "", osm_tags=("a=b",)) for n in "xy"]
    assert TagMatcher(features, [0.5, 0.5]).match({"a": "b"}) == 0


def test_tag_keys(town: Knowledge) -> None:
    assert town.tag_keys == {"building", "man_made", "amenity"}


def test_features(town: Knowledge) -> None:
    car, cottage = town.get_feature("Car"), town.get_feature("Cottage")
    assert not car.static
    assert cottage.static
    assert car.aliases == ("https://example.org/town#Automobile",)
    assert cottage.kinds == ("House", "Building", "StaticFeature")
    assert town.get_feature("House").osm_tags == ("building=house", "building=hut")


def test_environments(town: Knowledge) -> None:
    home, park, work = town.environments
    assert (home.label, home.definition, home.colour) == ("Homes", "Where people live.", "#aa0000")
    assert [(z.name, z.label) for z in home.zones] == [("HomeZone1", "HZ1")]
    assert not work.zones
    assert work.colour.startswith("#")  # "red" is none
    assert len({home.colour, park.colour, work.colour}) == 3


def test_schemes(town: Knowledge) -> None:
    assert town.schemes == {"everything": ("Home", "Park", "Work"), "busy": ("Home", "Work")}
    assert [e.name for e in town.scheme("busy")] == ["Home", "Work"]
    assert town.scheme() == town.environments
    assert town.proximity(scheme="busy").shape == (5, 2)
    np.testing.assert_array_equal(town.proximity(scheme="busy"), town.proximity()[:, [0, 2]])
    assert town.direct("busy").shape == (5, 2)
    with pytest.raises(UnknownNameError, match="no scheme 'idle'; there are: everything, busy"):
        town.scheme("idle")


def test_labels(town: Knowledge) -> None:
    assert town.labels["Home"] == "Homes"
    assert town.labels["Cottage"] == "Country cottage"
    assert town.labels["Playground"] == "Playground"


def test_repr(town: Knowledge) -> None:
    assert repr(town).endswith("town.ttl: 5 features, 3 environments, 8 indications)")
    html = town._repr_html_()
    assert "Where people live." in html
    assert html.count("<tr>") == 4


def test_html_is_escaped() -> None:
    bad = Environment("e", "E", "<script>", "a & b", '"><script>')
    knowledge = Knowledge((bad,), (), (), {"path": np.zeros((0, 1))}, {"all": ("E",)})
    assert "<script>" not in knowledge._repr_html_()
