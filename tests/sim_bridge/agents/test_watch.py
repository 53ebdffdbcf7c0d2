"""What is told of robots: gaps, silence, two of one name; once each, and when it is over."""

from typing import Any

from symboslam.sim_bridge.agents.watch import Watch


def run(robot: str = "r1", name: str = "a", **given: Any) -> dict[str, Any]:
    return {
        "robot": robot, "run": name, "increments": 3, "missing": [], "silent": 0.0,
        "began": "2026-01-01T00:00:00Z", "heard": "2026-01-01T00:01:00Z", "finished": False,
        **given,
    }  # fmt: skip


def test_gaps_are_told_after_a_time_and_when_they_close() -> None:
    watch = Watch(10, 60)
    gap = [run(missing=[[3, 5], [7, 7]])]
    assert watch.look(gap, 0.0) == watch.look(gap, 9.0) == []
    said = watch.look(gap, 11.0)
    assert said == [
        "robot r1 (run a): increments 3 to 5 are missing, for 11 seconds",
        "robot r1 (run a): increment 7 is missing, for 11 seconds",
    ]
    assert watch.look(gap, 99.0) == []
    assert watch.look([run(missing=[[7, 7]])], 100.0) == [
        "robot r1 (run a): some of what was missing has come"
    ]


def test_silence_is_told_once() -> None:
    watch = Watch(10, 60)
    assert watch.look([run(silent=59.0)], 0.0) == []
    assert watch.look([run(silent=61.0)], 0.0) == [
        "robot r1 (run a) has said nothing for 61 seconds"
    ]
    assert watch.look([run(silent=99.0)], 0.0) == []
    assert watch.look([run()], 0.0) == ["robot r1 (run a) is heard again"]
    assert watch.look([run(finished=True, silent=999.0)], 0.0) == [
        "robot r1 (run a) has finished, with 3 increments"
    ]


def test_two_of_one_name() -> None:
    watch = Watch(10, 60)
    later = {"began": "2026-01-01T00:01:00Z", "heard": "2026-01-01T00:02:00Z"}
    assert watch.look([run(), run("r2", "b"), run(name="c", **later)], 0.0) == []
    (said,) = watch.look([run(), run(name="b")], 0.0)
    assert "two robots at a time are called r1: runs a and b" in said
    assert watch.look([run(), run(name="b")], 0.0) == []


def test_the_end() -> None:
    watch = Watch(10, 60)
    assert not watch.ended([], 1)
    assert not watch.ended([run(), run("r2", finished=True)], 1)
    assert watch.ended([run(silent=61.0), run("r2", finished=True)], 2)
    assert not watch.ended([run(finished=True), run(name="b", finished=True)], 2)
