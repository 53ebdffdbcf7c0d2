"""Figures for Prometheus: they count what happens, and have few labels."""

from contextlib import closing

from prometheus_client.parser import text_string_to_metric_families

from tests.service.conftest import ADMIN, MakeService, Service
from tests.service.test_auth import bearer, make
from tests.service.test_limits import KILLER, LONG, QUICK, Killer, wait_until_busy
from tests.service.test_protocol import problem

ELSEWHERE = {"X-Forwarded-For": "203.0.113.7"}


def figures(service: Service) -> dict[tuple[str, tuple[tuple[str, str], ...]], float]:
    response = service.client.get("/metrics")
    assert response.status_code == 200
    assert response.headers["content-type"].startswith("text/plain")
    return {
        (sample.name, tuple(sorted(sample.labels.items()))): sample.value
        for family in text_string_to_metric_families(response.text)
        for sample in family.samples
    }


def requests(service: Service) -> dict[tuple[str, str, str], float]:
    """Requests by route, method and status."""
    return {
        (dict(labels)["route"], dict(labels)["method"], dict(labels)["status"]): value
        for (name, labels), value in figures(service).items()
        if name == "symboslam_http_requests_total"
    }


def test_requests_are_counted(make_service: MakeService) -> None:
    service = make_service()
    for _ in range(3):
        service.ask(QUICK)
    service.ask("nonsense")
    service.client.put("/graphs/x", content="", headers={**ADMIN, "Content-Type": "text/turtle"})
    for path in ("/a", "/b", "/healthz/c"):
        service.client.get(path)
    service.client.request("STRANGE", "/healthz")
    found = requests(service)
    assert found == {
        ("/sparql", "GET", "200"): 3,
        ("/sparql", "GET", "400"): 1,
        ("/graphs/{path:path}", "PUT", "201"): 1,
        ("none", "GET", "404"): 3,
        ("/healthz", "other", "405"): 1,
    }
    labels = (("method", "GET"), ("route", "/sparql"))
    seen = figures(service)
    assert seen["symboslam_http_request_seconds_count", labels] == 4
    assert seen["symboslam_http_request_seconds_sum", labels] > 0
    assert seen["symboslam_http_requests_running", ()] == 1  # this one
    assert seen["process_resident_memory_bytes", ()] > 1e6


def test_each_app_has_its_own(make_service: MakeService, service: Service) -> None:
    service.ask(QUICK)
    assert requests(make_service()) == {}


def test_queries_and_writes_are_counted(make_service: MakeService) -> None:
    service = make_service(workers=1, query_seconds=0.5)
    for number in range(3):
        service.update(f"INSERT DATA {{ <urn:s> <urn:p> {number} }}")
    problem(service.ask(KILLER), 504, "query-timeout")
    seen = figures(service)
    assert seen["symboslam_store_writes_total", ()] == 3
    assert seen["symboslam_queries_timeouts_total", ()] == 1
    assert seen["symboslam_workers_killed_total", ()] == 1
    assert seen["symboslam_store_ready", ()] == 1


def test_queries_that_run_and_wait_are_shown(make_service: MakeService) -> None:
    service = make_service(workers=1, query_seconds=LONG, queue_seconds=LONG)
    with closing(Killer(service)), closing(Killer(service)):
        while True:
            seen = figures(service)
            now = [seen[f"symboslam_queries_{what}", ()] for what in ("running", "waiting")]
            if now == [1, 1]:
                break
    wait_until_busy(service, 0)
    seen = figures(service)
    assert seen["symboslam_queries_waiting", ()] == 0
    assert seen["symboslam_queries_running", ()] == 0
    assert seen["symboslam_queries_timeouts_total", ()] == 0


def test_who_may_read_them(service: Service) -> None:
    assert service.client.get("/metrics").status_code == 200
    problem(service.client.get("/metrics", headers=ELSEWHERE), 401, "token-missing")
    writer = bearer(make(service, "query", "ingest", "update")["token"])
    response = service.client.get("/metrics", headers={**ELSEWHERE, **writer})
    problem(response, 403, "insufficient-scope")
    assert service.client.get("/metrics", headers={**ELSEWHERE, **ADMIN}).status_code == 200
