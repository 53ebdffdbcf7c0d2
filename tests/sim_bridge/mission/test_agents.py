"""A robot in pybullet turns its camera, stands at first, and is sent back."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest

pytest.importorskip("pybullet", reason="pybullet is not installed: pip install 'symboslam[sim]'")
pytest.importorskip("gtsam", reason="gtsam is not installed: pip install 'symboslam[slam]'")

from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.bridge.settings import BridgeSettings, DetectorSpec
from symboslam.sim_bridge.mission.control_agent import SCAN, ControlAgent
from symboslam.sim_bridge.mission.edge_agent import EdgeAgent
from symboslam.sim_bridge.mission.leash import LONG
from symboslam.sim_bridge.mission.targets import Target
from symboslam.sim_bridge.mission.team import MissionSettings, Team, assemble
from symboslam.sim_bridge.search.registry import search_of
from symboslam.sim_bridge.worlds.world import Extent, Start, World, WorldObject

HEADING = 0.4
WORLD = World(
    "left",
    Extent(0, 0, 200, 200),
    (WorldObject("house", "House", 50, 90, model="0"),),
    starts=(Start(50, 50, HEADING),),
)


@pytest.fixture(scope="module")
def knowledge() -> Knowledge:
    return Knowledge.load()


@pytest.fixture
def team(knowledge: Knowledge) -> Iterator[Team]:
    """One robot, and a house 40 m to the north of it."""
    sure = BridgeSettings(detector=DetectorSpec(misses=0, false_positives=0, confusion=0))
    made = assemble(WORLD, MissionSettings(robots=1, bridge=sure), knowledge)
    yield made
    made.close()


def test_it_looks_around_and_tells_bearings_from_the_heading(team: Team) -> None:
    (agent,) = team.agents
    found = []
    for n in range(4):
        seen = agent.sense(n / 2, {})
        found.append((round(math.degrees(agent.gaze)), [one.kind for one in seen]))
        for one in seen:
            assert one.bearing == pytest.approx(math.pi / 2 - HEADING, abs=0.05)
            assert one.range == pytest.approx(40, abs=3)
            assert math.hypot(0.7, 1.1) < one.sigma[0] < 2.0
    assert found == [(90, ["House"]), (-90, []), (180, []), (0, [])]


def test_each_second_picture_is_of_the_target(team: Team) -> None:
    (agent,) = team.agents
    agent.target = Target("House", 50, 90)
    gazes = []
    for n in range(8):
        agent.sense(n / 2, {})
        gazes.append(agent.gaze)
    there = math.pi / 2 - HEADING
    assert gazes[::2] == pytest.approx([there] * 4, abs=1e-6)
    assert sorted(round(math.degrees(gaze)) % 360 for gaze in gazes[1::2]) == [0, 90, 180, 270]


def test_robots_stand_and_look_around_at_first(team: Team) -> None:
    control = ControlAgent(team.agents, search_of("boustrophedon", team.area(), seed=0))
    assert control.assign(0.0, 0.5) == {"robot 1": None}
    assert control.assign(SCAN - 0.5, 0.5) == {"robot 1": None}
    assert control.assign(SCAN, 0.5)["robot 1"] is not None


def test_a_robot_that_knows_less_is_sent_back(team: Team, monkeypatch: pytest.MonkeyPatch) -> None:
    (agent,) = team.agents
    control = ControlAgent(team.agents, search_of("boustrophedon", team.area(), seed=0))
    sigma = [0.0]
    monkeypatch.setattr(EdgeAgent, "sigma", property(lambda _: sigma[0]))
    goal = control.assign(SCAN, 0.5)["robot 1"]
    sigma[0] = LONG + 1
    assert control.assign(SCAN + 0.5, 0.5)["robot 1"] == agent.pose[:2] != goal
    sigma[0] = 1.0
    assert control.assign(SCAN + 1, 0.5)["robot 1"] == goal


def test_a_map_that_cannot_be_kept_up_does_not_end_the_mission(team: Team) -> None:
    (agent,) = team.agents
    n = 0
    while not agent.mapper.solved:
        agent.sense(n / 2, {})
        agent.drive((150, 60), 0.5)
        n += 1
    sigma = agent.sigma
    edge = agent.mapper._run.edge_map()
    assert edge is not None
    edge.trouble = "the graph is underdetermined"
    assert agent.mapper.solved == 0
    agent.sense(n / 2, {})
    assert agent.sigma == sigma
