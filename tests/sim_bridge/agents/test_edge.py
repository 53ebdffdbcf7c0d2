"""The edge agent: increments at the log's own times, and a sender that gives up on nothing."""

import json
import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.readers.records import (
    FixRecord,
    OdometryRecord,
    Record,
    SightingRecord,
)
from symboslam.errors import InputError
from symboslam.sim_bridge.agents.edge import EdgeAgent
from symboslam.sim_bridge.agents.link import Link, LinkDownError, Patience, RefusedError
from symboslam.sim_bridge.agents.replay import paced, run_of
from symboslam.sim_bridge.agents.sender import Sender
from symboslam.sim_bridge.agents.spool import Spool, SpoolFullError
from tests.service.increments import increment
from tests.sim_bridge.agents.fakes import EdgeMapper

CLASSES = ("House", "Tree")
MIB = 1024 * 1024


@pytest.fixture
def spool(tmp_path: Path) -> Iterator[Spool]:
    found = Spool(tmp_path, "r1", "m1", MIB)
    found.begin("a")
    yield found
    found.close()


def drive(seconds: float) -> Iterator[Record]:
    for n in range(int(seconds * 10)):
        yield OdometryRecord(n / 10, (n / 10, 0.0, 0.0))
        yield SightingRecord(n / 10, 5.0, 0.1, "house", 0.9)


def index_of(name: str) -> int | None:
    found = {each.casefold(): i for i, each in enumerate(CLASSES)}
    return found.get(name.casefold())


def put(spool: Spool, number: int) -> None:
    for n in range(number):
        spool.put(EdgeIncrement.from_json(increment(sequence=n)))


def test_increments_come_at_intervals_of_the_log(spool: Spool) -> None:
    told: list[str] = []
    agent = EdgeAgent(EdgeMapper("r1", CLASSES, None, run="a"), spool, index_of, 1.0, told.append)
    for record in drive(3):
        agent.feed(record)
    agent.feed(FixRecord(2.95, 1.0, 2.0, 3.0))
    agent.feed(SightingRecord(2.95, 1.0, math.nan, "Robot"))
    agent.feed(SightingRecord(2.95, 1.0, math.nan, "Flurb"))
    agent.feed(OdometryRecord(1.0, (0.0, 0.0, 0.0)))
    agent.end()
    letters = spool.next(99, MIB)
    found = [EdgeIncrement.from_json(json.loads(each.content)) for each in letters]
    assert [each.sequence for each in found] == [0, 1, 2]
    assert [len(each.time) for each in found] == [11, 10, 9]
    assert [each.last for each in found] == [False, False, True]
    assert found[2].feature.tolist()[-1] == ""
    assert len(found[2].fix) == 1
    assert told == [
        "odometry at 1 s is out of order",
        "1 sightings of classes that nobody knows: 1 x Flurb",
    ]


def test_a_replay_has_the_name_of_its_content(tmp_path: Path) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    one.write_text("a")
    two.write_text("a")
    assert run_of(one, 1, None) == run_of(two, 1, None) != run_of(one, 2, None)
    two.write_text("b")
    assert run_of(one, 1) != run_of(two, 1)
    assert run_of(tmp_path, 1) == run_of(tmp_path, 1) != run_of(one, 1)
    with pytest.raises(InputError, match="cannot be read"):
        run_of(tmp_path / "none")


def test_records_come_at_their_pace() -> None:
    start = time.monotonic()
    assert len(list(paced(drive(1.0), 10))) == 20
    assert 0.08 < time.monotonic() - start < 5
    assert len(list(paced(drive(100.0), None))) == 2000


class FakeLink:
    """Answers as it is told to, and then takes everything."""

    def __init__(self, *answers: Exception) -> None:
        self.answers, self.taken = list(answers), list[str]()
        self.bad: tuple[str, int] | None = None

    def ask(self, method: str, path: str, **given: Any) -> None:
        assert (method, path) == ("POST", "/v1/maps/m%201/increments")
        if self.answers:
            raise self.answers.pop(0)
        lines = given["content"].decode().splitlines()
        if self.bad and any(self.bad[0] in line for line in lines):
            raise RefusedError("it is wrong", self.bad[1])
        self.taken += lines


def sent(spool: Spool, link: FakeLink, told: list[str]) -> Sender:
    sender = Sender(spool, link, "m 1", told.append)  # type: ignore[arg-type]
    sender.start()
    return sender


def test_a_sender_tries_until_it_is_taken(spool: Spool) -> None:
    told: list[str] = []
    link = FakeLink(LinkDownError("down", 0.01), LinkDownError("busy", 0.6))
    put(spool, 3)
    start = time.monotonic()
    sender = sent(spool, link, told)
    assert not sender.empty(0.1)
    assert sender.empty(30)
    assert time.monotonic() - start > 0.6, "what the service asks for is granted"
    sender.stop()
    assert len(link.taken) == 3
    assert told == ["down; trying again until it answers", "the service answers again"]


@pytest.mark.parametrize("status", [409, 413, 422])
def test_what_is_never_taken_is_put_aside(spool: Spool, status: int) -> None:
    told: list[str] = []
    link = FakeLink()
    link.bad = ('"sequence":1,', status)
    put(spool, 3)
    sender = sent(spool, link, told)
    assert sender.empty(30)
    sender.stop()
    assert (len(link.taken), sender.refused) == (2, 1)
    assert told == ["increment 1 of run a is refused and put aside: it is wrong"]


def test_a_wrong_token_keeps_everything(spool: Spool) -> None:
    told: list[str] = []
    put(spool, 2)
    sender = sent(spool, FakeLink(*[RefusedError("no", 401)] * 99), told)
    time.sleep(0.1)
    with pytest.raises(RefusedError, match="no"):
        sender.empty(None)
    sender.stop()
    assert spool.waiting == 2
    assert len(told) == 1


def test_what_ends_a_sender_is_told(spool: Spool) -> None:
    put(spool, 1)
    sender = sent(spool, FakeLink(ValueError("a defect")), [])
    with pytest.raises(ValueError, match="a defect"):
        sender.empty(30)


def test_a_full_spool_is_waited_for(tmp_path: Path) -> None:
    told: list[str] = []
    spool = Spool(tmp_path, "r1", "m 1", 3000)
    spool.begin("a")
    link = FakeLink(LinkDownError("down", 0.3))
    sender = sent(spool, link, told)
    agent = EdgeAgent(EdgeMapper("r1", CLASSES, None, run="a"), spool, index_of, 0.5, told.append)
    for record in drive(5):
        agent.feed(record)
    agent.end()
    assert sender.empty(30)
    sender.stop()
    spool.close()
    assert len(link.taken) == 10
    assert any("is full" in line and "nothing is read" in line for line in told)


def test_who_gives_up_is_told_that_it_is_full(tmp_path: Path) -> None:
    spool = Spool(tmp_path, "r1", "m 1", 1500)
    spool.begin("a")
    told: list[str] = []
    agent = EdgeAgent(
        EdgeMapper("r1", CLASSES, None, run="a"), spool, index_of, 0.5, told.append, lambda: True
    )

    def feed() -> None:
        for record in drive(9):
            agent.feed(record)

    with pytest.raises(SpoolFullError, match="is full"):
        feed()
    assert spool.waiting
    spool.close()


@pytest.mark.parametrize(
    ("status", "headers", "kind"),
    [(503, {"Retry-After": "7"}, LinkDownError), (429, {}, LinkDownError), (500, {}, LinkDownError),
     (404, {}, RefusedError), (301, {}, RefusedError)],
)  # fmt: skip
def test_what_a_link_makes_of_answers(
    status: int, headers: dict[str, str], kind: type[Exception]
) -> None:
    link = Link("http://127.0.0.1:9/", "token", 1.0)
    answer = httpx.MockTransport(
        lambda _: httpx.Response(status, headers=headers, json={"detail": "be\nso"})
    )
    link.close()
    link._client = httpx.Client(base_url=link.url, transport=answer)
    with pytest.raises(kind, match="be so") as found:
        link.ask("GET", "/x")
    assert getattr(found.value, "seconds", 0) == (7 if headers else 0)


def test_what_no_link_is() -> None:
    link = Link("http://127.0.0.1:9", None, 1.0)
    with pytest.raises(LinkDownError, match="cannot be reached"):
        link.ask("GET", "/")
    link.close()
    for url in ("ftp://x", "there"):
        with pytest.raises(InputError, match="no address"):
            Link(url, None, 1.0)
    with pytest.raises(InputError, match="token"):
        Link("http://x", "a b", 1.0)


def test_patience_grows() -> None:
    told: list[str] = []
    patience = Patience(told.append)
    waits = [patience.failed(LinkDownError("down")) for _ in range(10)]
    assert waits[0] <= 0.5
    assert 15 <= waits[-1] <= 30
    patience.worked()
    patience.worked()
    assert len(told) == 2
