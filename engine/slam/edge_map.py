"""EdgeMap: one robot's own landmark map, kept up to date with its pose graph (iSAM2).

Sightings become tracks by odometry alone. A track waits until odometry is no longer good enough to
compare it with others; in the meantime constellations of waiting tracks are looked for in the map.
What is found closes a loop, what is not found becomes a new landmark. Landmarks that lie within
their covariances are joined.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import gtsam
import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam import factors
from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.constellation import Placing, Things, match
from symboslam.engine.slam.edge_landmarks import EdgeLandmarks, Known
from symboslam.engine.slam.log import ROBOT, Floats, Pose
from symboslam.engine.slam.planar import between, compose, place
from symboslam.engine.slam.pose_graph import Fix, PoseGraph, Sighting
from symboslam.engine.slam.scale import Scale
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.tracks import Track, Tracker


class EdgeMap:
    """The map of one robot.

    Args:
        graph: its pose graph; whoever appends to it calls `follow`.
        beliefs: what sightings say about classes.
        dynamic: (C,) which classes move; such are tracked, but are nothing to go by.
        start: where it began.
        start_sigma: standard deviations of that.
        settings: of map building.
        known: landmarks that others have mapped; they get the first numbers.

    Attributes:
        tracker: its tracks.
        moving: tracks of things that move.
        landmark_of: number of a track -> number of its landmark.
        partial: sightings with a range or a bearing alone -> their landmark.
        trouble: why the map is not kept up to date any more; "" if it is.
    """

    def __init__(
        self,
        graph: PoseGraph,
        beliefs: ClassBeliefs,
        dynamic: NDArray[np.bool_],
        start: Pose,
        start_sigma: Pose,
        settings: SlamSettings,
        known: Sequence[Known] = (),
    ) -> None:
        self.graph, self.beliefs, self.settings = graph, beliefs, settings
        self.scale = Scale()
        self.tracker, self.moving = Tracker(graph, beliefs), Tracker(graph, beliefs)
        self.landmark_of: dict[int, int] = {}
        self.partial: list[tuple[Sighting, int]] = []
        self.trouble = ""
        self.estimate = np.array(start, float)
        self._start, self._start_sigma, self._dynamic = start, start_sigma, dynamic
        self._loss = factors.Loss(settings.kernel)
        params = gtsam.ISAM2Params()
        params.setRelinearizeThreshold(0.05)
        params.relinearizeSkip = 5
        params.setFactorization("QR")
        self._isam = gtsam.ISAM2(params)
        self._factors, self._values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        self._landmarks = EdgeLandmarks(beliefs.size)
        self._open: list[Track] = []
        self._done = self._poses = self._sightings = self._fixes = 0
        for landmark in known:
            self._take_known(landmark)

    def _take_known(self, known: Known) -> None:
        number = self._landmarks.new(known.xy, known.evidence)
        key = factors.landmark_key(number)
        self._values.insert(key, known.xy)
        factors.add_known(self._factors, key, known.xy, known.covariance)
        if known.name:
            self._landmarks.named[known.name] = number

    def follow(self, last: bool = False) -> None:
        """Take over what is new in the pose graph; with ``last`` decide on every track."""
        graph = self.graph
        while self._poses < len(graph):
            number = self._poses
            self._pose(number)
            self._poses += 1
            while (
                self._sightings < len(graph.sightings)
                and graph.sightings[self._sightings].pose <= number
            ):
                self._see(graph.sightings[self._sightings])
                self._sightings += 1
            while self._fixes < len(graph.fixes) and graph.fixes[self._fixes].pose <= number:
                self._fix(graph.fixes[self._fixes])
                self._fixes += 1
            if self._poses - self._done >= self.settings.every:
                self._update(False)
        if last:
            self._update(True)

    def _pose(self, number: int) -> None:
        key = factors.pose_key(0, number)
        if number == 0:
            factors.add_start(self._factors, key, self.estimate, self._start_sigma)
        else:
            step, sigma = self.graph.step[number], self.graph.sigma[number]
            before = factors.pose_key(0, number - 1)
            factors.add_step(self._factors, before, key, step, sigma)
            self.estimate = compose(self.estimate, step)
        self._values.insert(key, factors.pose(self.estimate))

    def _fix(self, fix: Fix) -> None:
        key = factors.pose_key(0, fix.pose)
        factors.add_fix(self._factors, key, np.array([fix.x, fix.y]), fix.sigma, self._loss)

    def _see(self, seen: Sighting) -> None:
        if seen.feature == ROBOT:
            return
        if not seen.whole:
            self._see_part(seen)
            return
        self.scale.see(seen)
        moves = bool(self._dynamic[seen.feature])
        tracker = self.moving if moves else self.tracker
        known = len(tracker.tracks)
        spacing = self.scale.spacing(self._poses)
        track = tracker.follow(seen, spacing, self.settings.join * spacing)
        if moves:
            return
        if track.number == known:
            self._open.append(track)
        elif track.number in self.landmark_of:
            self._add(seen, self.landmark_of[track.number])
        if track.key and track.number not in self.landmark_of:
            self._decide(track, self._landmarks.named.get(track.key), self._frame(self._poses - 1))

    def _update(self, last: bool) -> None:
        """Bring the map up to date; with ``last`` decide on every track that waits."""
        number = self._poses - 1
        if number < 0 or self.trouble:
            return
        self._done = self._poses
        try:
            self._isam.update(self._factors, self._values)
            self._factors, self._values = gtsam.NonlinearFactorGraph(), gtsam.Values()
            self._read(number)
            self.beliefs.learn(self._landmarks.classes())
            self._join(number)
            self._match(number, last)
            if last:
                self._isam.update(self._factors, self._values)
                self._factors, self._values = gtsam.NonlinearFactorGraph(), gtsam.Values()
                for _ in range(4):
                    self._isam.update()
                self._read(number)
        except RuntimeError as error:
            self.trouble = str(error).strip().split("\n", 1)[0]

    @property
    def outliers(self) -> int:
        """Things that were seen only once and are left out."""
        return sum(
            not track.live and track.number not in self.landmark_of for track in self.tracker.tracks
        )

    def poses(self) -> Floats:
        """(n, 3) key poses as estimated, those since the last update by odometry."""
        values = self._isam.calculateEstimate()
        found = np.zeros((len(self.graph), 3))
        for n in range(len(self.graph)):
            key = factors.pose_key(0, n)
            if values.exists(key):
                pose = values.atPose2(key)
                found[n] = pose.x(), pose.y(), pose.theta()
            elif n:
                found[n] = compose(found[n - 1], self.graph.step[n])
            else:
                found[n] = self._start
        return found

    def covariance(self, number: int) -> Floats:
        """(3, 3) of a key pose, in its own frame."""
        return np.asarray(self._isam.marginalCovariance(factors.pose_key(0, number)))

    @property
    def solved(self) -> int:
        """Key poses at the last update."""
        return 0 if self.trouble else self._done

    def _read(self, number: int) -> None:
        pose = self._isam.calculateEstimatePose2(factors.pose_key(0, number))
        self.estimate = np.array([pose.x(), pose.y(), pose.theta()])
        xy = self._landmarks.xy
        for n in range(len(xy)):
            xy[n] = self._isam.calculateEstimatePoint2(factors.landmark_key(n))

    def _frame(self, number: int) -> Floats:
        """Where the odometry's frame lies on the map, as seen from a key pose."""
        return compose(self.estimate, between(self.graph.odometry[number], np.zeros(3)))

    def _add(self, seen: Sighting, landmark: int) -> None:
        key = factors.pose_key(0, seen.pose)
        factors.add_sighting(self._factors, key, factors.landmark_key(landmark), seen, self._loss)
        evidence = self.beliefs.likelihood(seen.feature, seen.confidence)
        self._landmarks.see(landmark, seen.time, evidence)

    def _decide(self, track: Track, landmark: int | None, frame: Floats) -> None:
        """Give a track its landmark, a new one for None."""
        if landmark is None:
            xy = place(frame, track.xy)
            landmark = self._landmarks.new(xy)
            key = factors.landmark_key(landmark)
            self._values.insert(key, xy)
            factors.add_landmark(self._factors, key, xy, 10 * self.scale.spacing(self._done))
        self.landmark_of[track.number] = landmark
        if track.key:
            self._landmarks.named.setdefault(track.key, landmark)
        for seen in track.sightings:
            self._add(seen, landmark)

    def _see_part(self, seen: Sighting) -> None:
        """A range or a bearing alone says where a named landmark is, once there is one."""
        landmark = self._landmarks.named.get(seen.key) if seen.key else self._in_view(seen)
        if landmark is not None:
            self._add(seen, landmark)
            self.partial.append((seen, landmark))

    def _in_view(self, seen: Sighting) -> int | None:
        step = between(self.graph.odometry[self._poses - 1], self.graph.odometry[seen.pose])
        slack = 0.1 * self.scale.spacing(self._done)
        pose = compose(self.estimate, step)
        return self._landmarks.in_view(seen, pose, slack, self.scale.reach)

    def _match(self, number: int, last: bool) -> None:
        """Find waiting tracks in the map; those that waited long enough become new landmarks."""
        settings, graph = self.settings, self.graph
        waiting = [t for t in self._open if t.number not in self.landmark_of]
        if self.tracker.often:
            waiting = [t for t in waiting if t.live or len(t.sightings) > 1]
        ready = [t for t in waiting if len(t.sightings) > 1 or not t.live or last]
        frame = self._frame(number)
        if ready and len(self._landmarks):
            self._find(ready, number, frame)
        hold = settings.hold * self.scale.spacing(self._done)
        for track in ready:
            if track.number in self.landmark_of:
                continue
            if last or graph.drift(number, track.last) > hold**2:
                self._decide(track, None, frame)
        self._open = [t for t in waiting if t.number not in self.landmark_of]

    def _find(self, tracks: list[Track], number: int, frame: Floats) -> None:
        settings, graph = self.settings, self.graph
        spacing = self.scale.spacing(self._done)
        roots = self._landmarks.roots
        here = Things(
            place(frame, np.array([t.xy for t in tracks])), np.array([t.evidence for t in tracks])
        )
        there = self._landmarks.things(roots)
        covariance = self.covariance(number)
        arm = ((here.xy - self.estimate[:2]) ** 2).sum(1)
        sigma = np.array([t.sightings[0].sigma_range for t in tracks])
        spread = covariance[0, 0] + covariance[1, 1] + covariance[2, 2] * arm
        placing = Placing(spread / 2 + sigma**2, math.sqrt(covariance[2, 2]))
        base = (settings.base * float(np.median(sigma))) ** 2
        tolerance = np.sqrt(
            [[base + 2 * graph.drift(a.last, b.last) for b in tracks] for a in tracks]
        )
        live = {self.landmark_of.get(t.number) for t in self.tracker.live}
        allowed = np.tile([n not in live for n in roots], (len(tracks), 1))
        alike = self.beliefs.alike(here.evidence, there.evidence)
        for found in match(
            here, there, alike, placing, tolerance, spacing, allowed, settings.rival
        ):
            unseen = self.scale.unseen(
                sum(len(tracks[a].sightings) for a in found.here),
                math.sqrt(placing.variance[found.here].min()),
                float(np.hypot(*(here.xy[found.here] - there.xy[found.there]).T).min()),
            )
            if found.odds + unseen > settings.certainty and found.margin > settings.rival:
                for a, b in zip(found.here.tolist(), found.there.tolist(), strict=True):
                    self._decide(tracks[a], roots[b], frame)

    def _join(self, number: int) -> None:
        """Join two landmarks, one of them seen lately, that are one as far as can be told."""
        latest: dict[int, int] = {}
        for track, landmark in self.landmark_of.items():
            latest[landmark] = max(latest.get(landmark, 0), self.tracker.tracks[track].last)
        roots = sorted(latest)
        fresh = [n for n in roots if latest[n] >= number - 2 * self.settings.every]
        if not fresh:
            return
        spacing = self.scale.spacing(self._done)
        floor = self.settings.floor * self.scale.sigma
        landmarks = self._landmarks
        away = landmarks.xy[fresh][:, None] - landmarks.xy[roots][None]
        near = (away**2).sum(2) < spacing**2
        some = np.flatnonzero(near.any(0))  # the classes of the others do not matter
        roots, away, near = [roots[n] for n in some], away[:, some], near[:, some]
        alike = self.beliefs.alike(landmarks.evidence(fresh), landmarks.evidence(roots))
        near &= alike > 0
        covariance: dict[int, Floats] = {}
        for i, j in np.argwhere(near).tolist():
            one, other = fresh[i], roots[j]
            if one == other or landmarks.together(one, other):
                continue
            for n in (one, other):
                if n not in covariance:
                    covariance[n] = self._isam.marginalCovariance(factors.landmark_key(n))
            odds = self.scale.same(
                away[i, j],
                covariance[one] + covariance[other] + np.eye(2) * floor**2,
                float(alike[i, j]),
                landmarks.seen(one) + landmarks.seen(other),
                spacing,
            )
            if odds > self.settings.certainty:
                self._merge(min(one, other), max(one, other), floor / 4)
                return

    def _merge(self, keep: int, gone: int, sigma: float) -> None:
        one, other = factors.landmark_key(keep), factors.landmark_key(gone)
        factors.add_same(self._factors, one, other, sigma)
        for track, landmark in self.landmark_of.items():
            if landmark == gone:
                self.landmark_of[track] = keep
        self.partial = [(s, keep if n == gone else n) for s, n in self.partial]
        self._landmarks.merge(keep, gone)
