"""Mission: robots in a world from the first second to the last, at a fixed tick."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from symboslam.sim_bridge.bridge.scene import Others, Scene
from symboslam.sim_bridge.mission.control_agent import ControlAgent
from symboslam.sim_bridge.mission.edge_agent import EdgeAgent, things_seen
from symboslam.sim_bridge.mission.journal import Journal, Seen
from symboslam.sim_bridge.mission.team import Team
from symboslam.sim_bridge.mission.trouble import Finding
from symboslam.sim_bridge.search._base import Search
from symboslam.sim_bridge.search.area import Area
from symboslam.sim_bridge.search.coverage import Coverage
from symboslam.sim_bridge.search.swarm_metrics import dispersion, ideal_area

Pose = tuple[float, float, float]


@dataclass(frozen=True)
class Tick:
    """How far a mission has come.

    Attributes:
        time: simulated seconds.
        coverage: share of the ground that was swept.
        formula: the paper's A'/A.
        found: objects that were ranged.
        objects: all of them.
        dispersion: mean metres between two robots.
        factor: simulated over real seconds.
    """

    time: float
    coverage: float
    formula: float
    found: int
    objects: int
    dispersion: float
    factor: float


class Listener:
    """Is told what happens in a mission; each method may be left out."""

    def begin(self, team: Team) -> None:
        """All robots stand at their starts."""

    def rows(self, journal: Journal, seen: list[Seen]) -> None:
        """The last row of a robot's odometry, and what it saw then."""

    def tick(self, tick: Tick) -> None:
        """A tick has passed."""

    def event(self, time: float, robot: str, kind: str, text: str) -> None:
        """Something happened that is worth a line."""


def fly(
    team: Team,
    search: Search,
    listener: Listener | None = None,
    progress: Callable[[Tick], None] | None = None,
) -> Outcome:
    """Run a mission to its end: all found, out of time, nobody left to drive, or ctrl-C.

    The same settings, world and search give the same mission, whatever the clock says.

    Args:
        team: robots at their starts.
        search: the strategy.
        listener: is told all that happens, to record it.
        progress: is called after each tick.
    """
    return _Flight(team, search, listener or Listener(), progress or (lambda tick: None)).run()


@dataclass(frozen=True)
class Outcome:
    """How a mission ended.

    Attributes:
        last: the last tick.
        ended: ``all found``, ``time``, ``all given up`` or ``interrupted``.
        found: id of an object -> seconds when it was ranged first.
        ticks: all of them, one a simulated second.
        seconds: of real time.
        processor: seconds of it in which this process was on a processor.
    """

    last: Tick
    ended: str
    found: Mapping[str, float]
    ticks: tuple[Tick, ...]
    seconds: float
    processor: float


class _Flight:
    """The loop, step by step."""

    def __init__(
        self, team: Team, search: Search, listener: Listener, progress: Callable[[Tick], None]
    ) -> None:
        self._team, self._listener, self._progress = team, listener, progress
        s = team.settings
        self._control = ControlAgent(team.agents, search)
        self._area = team.area()
        self._swept = Coverage(team.area().extent, s.reach / 12)
        self._found: dict[str, float] = {}
        self._ticks: list[Tick] = []
        self._told = [0] * len(team.agents)
        self._bumps = [0] * len(team.agents)
        self._viewer: tuple[Scene, Others] | None = None
        if s.window:
            scene = Scene(team.agents[0].scene.stock, window=True)
            team.scenes.append(scene)
            self._viewer = scene, Others(scene)
        self._begun, self._used = clock.perf_counter(), clock.process_time()

    def run(self) -> Outcome:
        team, settings = self._team, self._team.settings
        step = 1 / settings.bridge.camera.rate
        number, ended = 0, "time"
        self._listener.begin(team)
        for note in team.notes:
            self._listener.event(0.0, "", "note", note)
        tick = self._tick(0.0)
        try:
            while True:
                time = number * step
                tick = self._sense(time)
                if len(self._found) == len(team.world.objects):
                    ended = "all found"
                    break
                if time >= settings.time_limit - 1e-9:
                    break
                if all(agent.lost for agent in team.agents):
                    ended = "all given up"
                    break
                self._act(time, step)
                number += 1
        except KeyboardInterrupt:
            ended = "interrupted"
        seconds = clock.perf_counter() - self._begun
        used = clock.process_time() - self._used
        self._listener.event(tick.time, "", "end", ended)
        return Outcome(tick, ended, dict(self._found), tuple(self._ticks), seconds, used)

    def _sense(self, time: float) -> Tick:
        """Every robot looks around and maps."""
        poses = {agent.name: agent.robot.pose for agent in self._team.agents}
        for n, agent in enumerate(self._team.agents):
            others = {name: pose for name, pose in poses.items() if name != agent.name}
            seen = agent.sense(time, others)
            for thing in sorted(things_seen(seen)):
                self._found.setdefault(thing, time)
            self._listener.rows(agent.journal, seen)
            for note in agent.scene.notes[self._told[n] :]:
                self._team.notes.append(note)
                self._listener.event(time, agent.name, "mesh", note)
            self._told[n] = len(agent.scene.notes)
        for agent in self._team.agents:
            x, y, heading = poses[agent.name]
            eye = np.array([x, y, heading + agent.gaze])
            self._swept.sweep(eye, eye, self._area.reach, agent.camera.spec.fov)
        tick = self._tick(time)
        if abs(time - round(time)) < 1e-9:
            self._ticks.append(tick)
        self._listener.tick(tick)
        self._progress(tick)
        if self._viewer is not None:
            self._viewer[0].follow([p[:2] for p in poses.values()])
            self._viewer[1].show(poses)
        return tick

    def _act(self, time: float, step: float) -> None:
        """The control agent gives goals, every robot drives."""
        goals = self._control.assign(time, step)
        for n, agent in enumerate(self._team.agents):
            goal = goals[agent.name]
            agent.drive(goal, step)
            if agent.bumps > self._bumps[n]:
                self._bumps[n] = agent.bumps
                self._listener.event(time, agent.name, "bump", "ran into something")
            finding = agent.look_after(time, goal is not None)
            if finding is not None:
                self._report(time, agent, finding)

    def _report(self, time: float, agent: EdgeAgent, finding: Finding) -> None:
        self._listener.event(time, agent.name, finding.kind, finding.text)
        if finding.kind == "given up":
            self._team.notes.append(f"{agent.name}: {finding.text} after {time:g} s")

    def _tick(self, time: float) -> Tick:
        real = clock.perf_counter() - self._begun
        return Tick(
            time,
            self._swept.share,
            formula(self._area, time),
            len(self._found),
            len(self._team.world.objects),
            dispersion(np.array([agent.robot.pose for agent in self._team.agents])),
            time / max(real, 1e-9),
        )


def formula(area: Area, seconds: float) -> float:
    """The paper's A'/A after some seconds, at most 1; W is the width of the sensor's sector."""
    width = 2 * area.reach * math.sin(min(area.fov, math.pi) / 2)
    ideal = ideal_area(area.speed, width, seconds, area.robots)
    return min(ideal / (area.width * area.height), 1.0)
