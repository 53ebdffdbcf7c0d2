"""The control agent against a true service: what it sets, what it sends again, what it tells."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("fastapi", reason="needs symboslam[service]")

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.agents.classes import Classes
from symboslam.sim_bridge.agents.control import ControlAgent, ControlSettings, keep
from symboslam.sim_bridge.agents.link import Link, RefusedError
from tests.service.conftest import TOKEN, Service, running
from tests.service.increments import increment
from tests.service.test_increments import post
from tests.service.test_maps import at, get, make, send

CLASSES = ("House", "Tree", "Flurb")


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with running(
        data=tmp_path_factory.mktemp("maps"), admin_token=TOKEN, bundled_ontology=False,
        workers=1, rate="none",
    ) as found:  # fmt: skip
        yield found


@pytest.fixture(scope="module", autouse=True)
def link(service: Service) -> Iterator[Link]:
    found = Link(service.url, TOKEN, 30.0)
    LINKS[service.url] = found
    yield found
    found.close()


LINKS: dict[str, Link] = {}


class Given:
    """A collective map that is what it is told to be."""

    def __init__(self) -> None:
        self.notes: list[str] = []
        self.added: list[EdgeIncrement] = []
        self.solved: list[int] = []
        self.landmarks: dict[str, tuple[int, float, float]] = {}

    def add(self, increment: EdgeIncrement) -> None:
        self.added.append(increment)

    def solve(self) -> SlamMap:
        self.solved.append(len(self.added))
        m, n = self.landmarks, len(self.landmarks)
        column = np.empty(n, object)
        column[:] = list(m)
        xy = np.array([each[1:] for each in m.values()], float).reshape(-1, 2)
        return SlamMap({}, MappedLandmarks(
            column, xy, np.zeros((n, 2, 2)), np.array([each[0] for each in m.values()], np.int64),
            np.full(n, 0.9), np.full(n, 3), np.zeros(n, bool), np.full(n, "", object),
        ), {}, doubts=("robot r1 could not be placed",))  # fmt: skip


def agent(
    service: Service, which: str, collective: Given, told: list[str], **given: Any
) -> ControlAgent:
    settings = ControlSettings(**{"every": 0.05, "tolerance": 0.5, **given})
    return ControlAgent(LINKS[service.url], which, CLASSES, collective, settings, told.append)


def landmarks(service: Service, which: str) -> dict[str, Any]:
    found = get(service, f"{which}/landmarks")["features"]
    return {f["id"]: f["geometry"]["coordinates"] for f in found}


def test_differences_are_sent(service: Service) -> None:
    which, collective, told = make(service), Given(), list[str]()
    send(service, which, at("Tree", 300, 300))
    keeper = agent(service, which, collective, told)
    collective.landmarks = {"a": (0, 1.0, 2.0), "b": (1, 5.0, 6.0), "n": (0, np.nan, 1.0)}
    keeper.publish()
    ours = {"control/a": [1.0, 2.0], "control/b": [5.0, 6.0]}
    assert landmarks(service, which) == {"L1": [300.0, 300.0], **ours}
    revision = get(service, which)["revision"]
    collective.landmarks |= {"a": (0, 1.3, 2.0)}
    keeper.publish()
    assert get(service, which)["revision"] == revision, "it hardly moved"
    collective.landmarks |= {"b": (1, 5.0, 7.0), "c": (0, 9.0, 9.0)}
    keeper.publish()
    assert landmarks(service, which)["control/a"] == [1.0, 2.0]
    assert landmarks(service, which)["control/b"] == [5.0, 7.0]
    del collective.landmarks["b"]
    collective.landmarks |= {"d": (2, 1.0, 1.0), "e": (0, 5000.0, 1.0)}
    keeper.publish(final=True)
    assert set(landmarks(service, which)) == {"L1", "control/a", "control/c"}
    assert landmarks(service, which)["control/a"] == [1.3, 2.0]
    assert told == [
        "robot r1 could not be placed",
        "1 landmarks are outside the map; classes that the map does not know: Flurb",
    ]


def test_one_that_begins_anew_leaves_nothing_behind(service: Service) -> None:
    which, collective = make(service), Given()
    collective.landmarks = {"a": (0, 1.0, 2.0), "b": (1, 5.0, 6.0)}
    agent(service, which, collective, []).publish()
    post(service.client, which, increment(), increment(sequence=1, last=True))
    collective.landmarks = {"b": (1, 7.0, 6.0)}
    agent(service, which, collective, []).run(once=True)
    assert [each.sequence for each in collective.added] == [0, 1]
    assert landmarks(service, which) == {"control/b": [7.0, 6.0]}


def test_one_that_begins_anew_reads_everything_first(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    which, collective = make(service), Given()
    post(service.client, which, *(increment(sequence=n, last=n == 6) for n in range(7)))
    monkeypatch.setattr("symboslam.sim_bridge.agents.control._AT_A_TIME", 1)
    agent(service, which, collective, [], every=0.0).run(once=True)
    assert collective.solved == [7, 7]


def test_the_end_is_when_all_robots_have_ended(service: Service) -> None:
    which, collective, told = make(service), Given(), list[str]()
    post(service.client, which, increment(), increment(sequence=2), increment("r2", last=True))
    agent(service, which, collective, told, silent=1.0, patience=0.0, robots=2).run(once=True)
    assert len(collective.added) == 3
    assert "robot r1 (run a): increment 1 is missing, for 0 seconds" in told
    assert "robot r2 (run a) has finished, with 1 increments" in told
    assert any("r1 (run a) has said nothing" in line for line in told)


def test_several_maps_at_once_and_one_that_is_not_there(service: Service) -> None:
    maps, told = [make(service) for _ in range(3)], list[str]()
    collectives = {which: Given() for which in (*maps, "none")}
    for n, which in enumerate(maps):
        post(service.client, which, *(increment(sequence=k) for k in range(n)))
        post(service.client, which, increment(sequence=n, last=True))
    agents = {which: agent(service, which, each, told) for which, each in collectives.items()}
    with pytest.raises(RefusedError, match="there is no map 'none'"):
        keep(agents, True, told.append)
    assert [len(collectives[which].added) for which in maps] == [1, 2, 3]
    assert any(line.startswith("map none is kept no longer") for line in told)


def test_the_classes_of_an_ontology() -> None:
    knowledge = Knowledge.load()
    classes = Classes.of(knowledge)
    index = {name: i for i, name in enumerate(classes.names)}
    assert classes.dynamic[index["Car"]]
    assert not classes.dynamic[index["House"]]
    s = classes.similarity
    np.testing.assert_allclose(s, s.T)
    np.testing.assert_allclose(np.diag(s), 1.0)
    assert s.min() >= 0
    assert s[index["House"], index["Apartment"]] > s[index["House"], index["Tree"]]
    assert s[index["House"], index["Car"]] == 0
