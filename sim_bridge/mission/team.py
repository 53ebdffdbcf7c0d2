"""Team: the robots of a mission and what they share, put together from a world and settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from symboslam.engine.slam.edge import EdgeMapper
from symboslam.engine.slam.log import Mission as SlamMission
from symboslam.engine.slam.log import Truth
from symboslam.engine.slam.settings import SlamSettings
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.agents.classes import Classes
from symboslam.sim_bridge.bridge.camera import Camera
from symboslam.sim_bridge.bridge.detections import get_detector
from symboslam.sim_bridge.bridge.lidar import Lidar
from symboslam.sim_bridge.bridge.odometry import Gps, WheelOdometry, noise_of
from symboslam.sim_bridge.bridge.robots import get_robot
from symboslam.sim_bridge.bridge.scene import Scene
from symboslam.sim_bridge.bridge.settings import BridgeSettings
from symboslam.sim_bridge.bridge.stock import Stock
from symboslam.sim_bridge.mission.edge_agent import EdgeAgent
from symboslam.sim_bridge.mission.journal import START_SIGMA
from symboslam.sim_bridge.search.area import Area
from symboslam.sim_bridge.worlds.checks import free_starts
from symboslam.sim_bridge.worlds.sizes import CLASSES
from symboslam.sim_bridge.worlds.starts import with_starts
from symboslam.sim_bridge.worlds.world import World

Pose = tuple[float, float, float]

MAPPING = SlamSettings(interval=1.0, every=5, join=0.03, hold=0.03, confirm=3, repairs=1)
"""A key pose a second, half as many as by default, which takes half the time. Each picture of a
camera that turns shows little, so that landmarks seem farther apart than they are: `join` and
`hold` are smaller shares of that. Repairs take the longest by far."""


@dataclass(frozen=True)
class MissionSettings:
    """How a mission goes.

    Attributes:
        robots: how many.
        kind: ``kinematic`` or ``husky``.
        detector: ``seg`` or ``onnx``.
        time_limit: simulated seconds.
        seed: of all that is random.
        reach: metres within which ground counts as looked at.
        window: whether to show it.
        bridge: robots and sensors.
    """

    robots: int = 3
    kind: str = "kinematic"
    detector: str = "seg"
    time_limit: float = 2400.0
    seed: int = 0
    reach: float = 60.0
    window: bool = False
    bridge: BridgeSettings = field(default_factory=BridgeSettings)


@dataclass
class Team:
    """The robots of a mission and what they share.

    Attributes:
        world: with starts that are free.
        agents: the robots.
        scenes: one for each robot.
        classes: numbers of classes for map building.
        settings: of the mission.
        notes: what is odd, one sentence each.
    """

    world: World
    agents: list[EdgeAgent]
    scenes: list[Scene]
    classes: Classes
    settings: MissionSettings
    notes: list[str]

    def close(self) -> None:
        """Leave all physics clients."""
        for scene in self.scenes:
            scene.close()

    def area(self) -> Area:
        """What is to be searched, as the search strategies know it: without obstacles."""
        e, s = self.world.extent, self.settings
        return Area(
            (e.min_x, e.min_y, e.max_x, e.max_y),
            tuple(agent.journal.start for agent in self.agents),
            min(agent.robot.top_speed for agent in self.agents),
            s.reach,
            s.bridge.camera.field,
        )

    def slam_mission(self) -> SlamMission:
        """All logs, with the truth for those who measure."""
        position = {name: n for n, name in enumerate(self.classes.names)}
        bridge = self.settings.bridge
        label = _labels(position)
        sigma_fix = bridge.gps.sigma if bridge.gps else 3.0
        journals = [agent.journal for agent in self.agents]
        logs = [j.log(label, noise_of(bridge.odometry), sigma_fix) for j in journals]
        truth = Truth(
            {o.id: (o.x, o.y) for o in self.world.objects},
            {j.name: np.array([(t, *p) for t, p in j.truth], float) for j in journals},
            {o.id: self.classes.names[label[o.kind]] for o in self.world.objects},
        )
        identity = {}
        for j in journals:
            column = np.empty(len(j.seen), object)
            column[:] = [s.thing for s in j.seen]
            identity[j.name] = column
        return SlamMission(
            tuple(logs), self.classes.names, self.classes.dynamic, self.classes.similarity,
            identity, truth,
        )  # fmt: skip


def assemble(world: World, settings: MissionSettings, knowledge: Knowledge) -> Team:
    """Robots at their starts, each with its scene, sensors and mind.

    Args:
        world: starts inside objects are moved out of them.
        settings: of the mission.
        knowledge: which classes there are.

    Raises:
        InputError: fewer starts than robots, or a robot or detector that does not exist.
        MissingExtraError: pybullet is not installed.
    """
    world, notes = free_starts(with_starts(world))
    if not 1 <= settings.robots <= len(world.starts):
        raise InputError(
            f"{settings.robots} robots: {world.name} has starts for 1 to {len(world.starts)}"
        )
    classes = Classes.of(knowledge)
    label = _labels({name: n for n, name in enumerate(classes.names)})
    stock, bridge = Stock(world), settings.bridge
    team = Team(world, [], [], classes, settings, list(notes))
    try:
        for n in range(settings.robots):
            seeds = np.random.SeedSequence([settings.seed, n]).spawn(5)
            rngs = [np.random.default_rng(seed) for seed in seeds]
            scene = Scene(stock)
            team.scenes.append(scene)
            at = world.starts[n]
            start = (at.x, at.y, at.heading)
            scene.follow([start[:2]])
            robot = get_robot(settings.kind, f"robot {n + 1}", scene, start, bridge)
            start = robot.pose
            least = bridge.detector.least_height / bridge.camera.focal
            detector = get_detector(settings.detector, bridge.detector, CLASSES, rngs[0])
            agent = EdgeAgent(
                scene,
                robot,
                Camera(scene, bridge.camera, least),
                detector,
                Lidar(scene, bridge.lidar, rngs[1], body=bridge.radius),
                WheelOdometry(start, bridge.odometry, rngs[2]),
                Gps(bridge.gps, rngs[3]) if bridge.gps else None,
                EdgeMapper(
                    robot.name, classes.names, classes.dynamic, start=start,
                    start_sigma=START_SIGMA, noise=noise_of(bridge.odometry), settings=MAPPING,
                ),
                label,
                start,
                bridge,
            )  # fmt: skip
            team.agents.append(agent)
    except BaseException:
        team.close()
        raise
    return team


def _labels(position: Mapping[str, int]) -> dict[str, int]:
    """Detector class -> number of the feature of the ontology."""
    by_case = {name.casefold(): n for name, n in position.items()}
    return {
        name: by_case.get(name.casefold(), by_case.get(f"unspecified{name.casefold()}", 0))
        for name in CLASSES
    }
