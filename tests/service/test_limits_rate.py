"""How often and how much at a time one client may ask."""

import asyncio
import socket
from contextlib import closing

import pytest

from symboslam.service import server
from symboslam.service.limits import DEFAULT_RATES, Buckets, Limits, Rate, client_of, parse_rates
from symboslam.service.problems import Problem
from tests.service.conftest import ADMIN, UPDATE, MakeService, Service
from tests.service.test_auth import bearer, make
from tests.service.test_limits import KILLER, LONG, QUICK, Killer, wait_until_busy
from tests.service.test_protocol import problem

ORIGIN = {"Origin": "https://maps.example"}


def from_(address: str) -> dict[str, str]:
    """A client elsewhere: the server trusts proxies on its own machine."""
    return {"X-Forwarded-For": address}


def test_rates_are_read() -> None:
    assert parse_rates("") == DEFAULT_RATES
    assert parse_rates("none") == {}
    assert set(parse_rates("600/minute").values()) == {Rate(600, 60)}
    some = parse_rates("query=5/second, admin=7/hour")
    assert (some["query"], some["admin"]) == (Rate(5, 1), Rate(7, 3600))
    assert some["ingest"] == DEFAULT_RATES["ingest"]


@pytest.mark.parametrize(
    "text", ["600", "0/minute", "-1/minute", "x=1/minute", "1/day", "1/minute;"]
)
def test_what_is_no_rate(text: str) -> None:
    with pytest.raises(ValueError, match="not a rate"):
        parse_rates(text)


def test_a_bucket_fills_steadily() -> None:
    now = 0.0
    buckets = Buckets(clock=lambda: now)
    rate = Rate(3, 6)  # one in 2 s
    key = ("a", "query")
    assert [buckets.take(key, rate) for _ in range(4)] == [2, 1, 0, -1]
    now = 1.0
    assert buckets.take(key, rate) == -0.5
    now = 2.0
    assert buckets.take(key, rate) == 0
    now = 1000.0  # never more than three
    assert [buckets.take(key, rate) for _ in range(4)] == [2, 1, 0, -1]
    assert buckets.take(("a", "update"), rate) == 2
    assert buckets.take(("b", "query"), rate) == 2


def test_many_addresses_take_no_more_room() -> None:
    buckets = Buckets(size=10, clock=lambda: 0.0)
    rate = Rate(2, 60)
    buckets.take(("robot", "query"), rate)
    for number in range(1000):
        buckets.take((str(number), "query"), rate)
        if number % 5 == 0:
            buckets.take(("robot", "query"), rate)
    assert len(buckets) == 10
    assert buckets.take(("robot", "query"), rate) < 0, "what is in use is not forgotten"


def test_whom_limits_are_counted_for() -> None:
    def client(host: str, token: str | None = None) -> str | None:
        return client_of({"client": (host, 1)}, token)

    assert client("127.0.0.1") is client("::1") is client("::ffff:127.0.0.1") is None
    assert client("127.0.0.1", "abc") == client("203.0.113.7", "abc") == "token abc"
    assert client("203.0.113.7") == client("::ffff:203.0.113.7") == "203.0.113.7"
    assert client("2001:db8:1:2::3") == client("2001:db8:1:2:ffff::") == "2001:db8:1:2::/64"
    assert client("2001:db8:1:3::3") != client("2001:db8:1:2::3")
    assert client("not-an-address") == "not-an-address"
    assert client_of({"client": None}, None) is None


def test_too_many_requests(make_service: MakeService) -> None:
    service = make_service(rate="query=2/hour", cors_origins=ORIGIN["Origin"])
    headers = {**from_("203.0.113.7"), **ORIGIN}

    def ask(**more: str) -> int:
        return service.client.get(
            "/sparql", params={"query": QUICK}, headers={**headers, **more}
        ).status_code

    first = service.client.get("/sparql", params={"query": QUICK}, headers=headers)
    assert first.headers["ratelimit-policy"] == '"query";q=2;w=3600'
    assert first.headers["ratelimit"] == '"query";r=1;t=1800'
    assert ask() == 200
    refused = service.client.get("/sparql", params={"query": QUICK}, headers=headers)
    problem(refused, 429, "too-many-requests")
    assert 1790 < int(refused.headers["retry-after"]) <= 1800
    assert refused.headers["ratelimit"].startswith('"query";r=0;t=')
    assert refused.headers["access-control-allow-origin"] == ORIGIN["Origin"]
    exposed = refused.headers["access-control-expose-headers"]
    assert {"RateLimit", "Retry-After"} <= set(exposed.split(", "))
    assert ask(**from_("203.0.113.8")) == 200, "another client"
    for _ in range(4):  # from this machine
        assert service.ask(QUICK).status_code == 200
    update = service.client.post("/sparql", content="CLEAR ALL", headers={**headers, **UPDATE})
    assert update.status_code == 204, "another scope"


def test_a_token_has_limits_of_its_own(make_service: MakeService) -> None:
    service = make_service(rate="query=1/hour")
    one, other = (bearer(make(service, "query")["token"]) for _ in range(2))
    url = "/sparql?query=ASK+%7B%7D"
    assert service.client.get(url, headers=one).status_code == 200
    problem(service.client.get(url, headers=one), 429, "too-many-requests")
    elsewhere = {**one, **from_("203.0.113.7")}
    problem(service.client.get(url, headers=elsewhere), 429, "too-many-requests")
    assert service.client.get(url, headers=other).status_code == 200


def test_wrong_tokens_count_for_the_address(make_service: MakeService) -> None:
    service = make_service(rate="admin=3/hour")
    seen = [
        service.client.get(
            "/v1/tokens", headers={**bearer(f"guess-{i}"), **from_("203.0.113.7")}
        ).status_code
        for i in range(5)
    ]
    assert seen == [401, 401, 401, 429, 429]


def test_twenty_robots_that_share_a_token_are_within_the_defaults() -> None:
    now = 0.0
    buckets = Buckets(clock=lambda: now)
    for request in range(20 * 10 * 300):  # ten a second each, for five minutes
        now = request / (20 * 10)
        assert buckets.take(("robots", "ingest"), DEFAULT_RATES["ingest"]) >= 0


def test_one_client_cannot_take_all_workers(make_service: MakeService) -> None:
    service = make_service(workers=2, query_seconds=LONG, queue_seconds=0.2)
    greedy = bearer(make(service, "query")["token"])
    with closing(Killer(service, **greedy)):
        wait_until_busy(service, 1)
        for _ in range(2):
            response = service.client.get("/sparql", params={"query": QUICK}, headers=greedy)
            problem(response, 429, "too-many-at-a-time")
            assert int(response.headers["retry-after"]) > 0
        response = service.client.get("/graphs?default", headers=greedy)
        problem(response, 429, "too-many-at-a-time")
        assert service.values(QUICK) == [["1"]], "others have the other worker"
        assert service.update("CLEAR ALL").status_code == 204
    wait_until_busy(service, 0)
    while service.client.get("/sparql", params={"query": QUICK}, headers=greedy).is_error:
        pass  # until the server has seen that the killer's client is gone


def test_requests_at_a_time(make_service: MakeService) -> None:
    service = make_service(workers=3, query_seconds=LONG, client_requests=1)
    greedy = bearer(make(service, "query")["token"])
    with closing(Killer(service, **greedy)):
        wait_until_busy(service, 1)
        problem(service.client.get("/healthz", headers=greedy), 429, "too-many-at-a-time")
        assert service.client.get("/healthz").status_code == 200


def test_what_is_over_is_forgotten() -> None:
    async def use(limits: Limits) -> list[str]:
        order = []

        async def one(name: str) -> None:
            async with limits.turn("a"):
                order.append(name)
                await asyncio.sleep(0)

        with limits.running("a"), limits.running("b"):
            await asyncio.gather(*(one(str(number)) for number in range(5)))
            with pytest.raises(Problem), limits.running("a"):
                pass
        return order

    limits = Limits({}, at_a_time=1, queries=1, seconds=LONG)
    assert asyncio.run(use(limits)) == list("01234")
    assert not limits._running
    assert not limits._queues


def talk(service: Service, *sent: bytes) -> bytes:
    """What the service says until it closes the connection."""
    host, _, port = service.url.removeprefix("http://").partition(":")
    with socket.create_connection((host, int(port)), timeout=30) as connection:
        for part in sent:
            connection.sendall(part)
        found = b""
        while more := connection.recv(65536):
            found += more
        return found


@pytest.mark.parametrize(
    "request_line",
    [
        b"POST /sparql HTTP/1.1\r\nContent-Type: application/sparql-query",
        b"POST /v1/tokens HTTP/1.1\r\nContent-Type: application/json",
    ],
)
def test_a_body_that_does_not_arrive(make_service: MakeService, request_line: bytes) -> None:
    service = make_service(body_seconds=0.3)
    said = talk(service, request_line, b"\r\nHost: x\r\nContent-Length: 9\r\n\r\n", b"ASK")
    assert said.startswith(b"HTTP/1.1 408 ")
    assert b"problems#body-too-slow" in said
    assert service.values(QUICK) == [["1"]]


def test_a_query_by_get_with_a_body_that_does_not_arrive(make_service: MakeService) -> None:
    from urllib.parse import urlencode

    service = make_service(body_seconds=0.3, query_seconds=LONG)
    line = f"GET /sparql?{urlencode({'query': KILLER})} HTTP/1.1\r\n"
    said = talk(service, line.encode(), b"Host: x\r\nContent-Length: 9\r\n\r\n")
    assert said.startswith(b"HTTP/1.1 408 ")


def test_a_slow_query_is_no_slow_body(make_service: MakeService) -> None:
    service = make_service(body_seconds=0.2, query_seconds=1)
    response = service.client.post("/sparql", data={"query": KILLER})
    problem(response, 504, "query-timeout")


def test_a_head_that_does_not_arrive(
    make_service: MakeService, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server, "_HEADER_SECONDS", 0.2)
    service = make_service(query_seconds=1)
    assert talk(service) == b""
    assert talk(service, b"GET /healthz HTTP/1.1\r\nHost: ") == b""
    whole = b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n"
    said = talk(service, whole, b"GET /healthz HTTP/1.1\r\n")  # and half of a second one
    assert said.count(b"HTTP/1.1 200 ") == 1
    problem(service.ask(KILLER), 504, "query-timeout")  # a head that has arrived is not waited for


def test_who_may_not_write_sends_no_large_bodies(make_service: MakeService) -> None:
    service = make_service(max_query_bytes=1000)
    long = "#" + "x" * 5000
    form = {"update": long}
    problem(service.client.post("/sparql", data=form), 413, "body-too-large")
    reader = bearer(make(service, "query")["token"])
    problem(service.client.post("/sparql", data=form, headers=reader), 413, "body-too-large")
    pieces = (b'"' + b"x" * 500 for _ in range(10))
    response = service.client.post(
        "/v1/tokens", content=pieces, headers={"Content-Type": "application/json"}
    )
    problem(response, 413, "body-too-large")
    assert service.client.post("/sparql", data=form, headers=ADMIN).status_code == 204
