"""Increments for tests: small pieces of a robot's drive."""

from typing import Any


def increment(
    robot: str = "r1", run: str = "a", sequence: int = 0, last: bool = False, x: float = 1.0
) -> dict[str, Any]:
    """The JSON of a piece of two key poses and a house."""
    return {
        "robot": robot, "run": run, "sequence": sequence, "start": [x, 2.0, 0.0],
        "start_sigma": [0.1, 0.1, 0.01], "first": 2 * sequence,
        "time": [2.0 * sequence, 2.0 * sequence + 1], "step": [[1.0, 0.0, 0.0]] * 2,
        "sigma": [[0.1, 0.1, 0.01]] * 2, "row": [sequence],
        "seen": [0.0], "pose": [2 * sequence], "range": [5.0],
        "bearing": [None], "sigma_range": [0.5], "sigma_bearing": [0.02], "feature": ["House"],
        "confidence": [0.8], "key": [""], "track": [-1], "fix_pose": [], "fix": [], "last": last,
    }  # fmt: skip
