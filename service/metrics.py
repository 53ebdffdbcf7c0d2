"""Figures for Prometheus at ``/metrics``: one registry for each app, labels with few values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fastapi import APIRouter, Request, Response
from prometheus_client import (
    CollectorRegistry,
    Counter,
    Gauge,
    GCCollector,
    Histogram,
    PlatformCollector,
    ProcessCollector,
)
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.exposition import choose_encoder
from prometheus_client.registry import Collector

from symboslam import __version__
from symboslam.service.auth import authorize, declare
from symboslam.service.limits import address_of
from symboslam.service.store._base import Store

router = APIRouter(tags=["Health"])

_METHODS = ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS")
_SECONDS = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60)


class Metrics:
    """The figures of one service.

    Attributes:
        collectors: where further counters are registered:
            ``Counter(name, text, registry=metrics.collectors)``.
        running: requests that are being answered.
    """

    def __init__(self) -> None:
        self.collectors = CollectorRegistry()
        labels = ("route", "method", "status")
        self._requests = Counter(
            "symboslam_http_requests", "Requests answered.", labels, registry=self.collectors
        )
        self._seconds = Histogram(
            "symboslam_http_request_seconds", "Time from a request to the end of its response.",
            ("route", "method"), buckets=_SECONDS, registry=self.collectors,
        )  # fmt: skip
        self._batches = Counter(
            "symboslam_batches", "Batches of observations taken.", registry=self.collectors
        )
        self._observations = Counter(
            "symboslam_observations", "Observations in them.", registry=self.collectors
        )
        self._ingest = Histogram(
            "symboslam_ingest_seconds",
            "From batches that are taken together to the store that says what they changed.",
            buckets=_SECONDS, registry=self.collectors,
        )  # fmt: skip
        self.running = Gauge(
            "symboslam_http_requests_running", "Requests at this moment.", registry=self.collectors
        )
        build = Gauge("symboslam_build", "This version.", ("version",), registry=self.collectors)
        build.labels(__version__).set(1)
        ProcessCollector(registry=self.collectors)
        PlatformCollector(registry=self.collectors)
        GCCollector(registry=self.collectors)

    def watch(self, store: Store) -> None:
        """Show what a store does."""
        self.collectors.register(_StoreCollector(store))

    def taken(self, batches: int, observations: int, seconds: float) -> None:
        """Count batches of observations that were merged and classified together."""
        self._batches.inc(batches)
        self._observations.inc(observations)
        self._ingest.observe(seconds)

    def observe(self, route: str, method: str, status: int, seconds: float) -> None:
        """Count a request that was answered.

        Args:
            route: the template of its path, never the path.
            method: as it was sent.
            status: of the response.
            seconds: that it took.
        """
        known = method if method in _METHODS else "other"
        self._requests.labels(route, known, status).inc()
        self._seconds.labels(route, known).observe(seconds)


class _StoreCollector(Collector):
    def __init__(self, store: Store) -> None:
        self._store = store

    def collect(self) -> Iterator[Metric]:
        """The figures at this moment."""
        now = self._store.activity
        ready, name = float(self._store.ready), "symboslam_store_ready"
        yield GaugeMetricFamily(name, "1: queries can be answered.", ready)
        for name, text, value in (
            ("symboslam_queries_running", "Queries and updates in a worker.", now.running),
            ("symboslam_queries_waiting", "Queries that wait for a worker.", now.waiting),
        ):
            yield GaugeMetricFamily(name, text, value)
        for name, text, value in (
            ("symboslam_queries_timeouts", "Queries stopped at the time limit.", now.timeouts),
            ("symboslam_workers_killed", "Workers that were killed or crashed.", now.killed),
            ("symboslam_store_writes", "Writes since the start; its version.", now.writes),
        ):
            yield CounterMetricFamily(name, text, value)


@router.get(
    "/metrics", summary="Figures for Prometheus", dependencies=[declare("admin")],
    response_class=Response, openapi_extra={"security": [{}]}, responses={200: {"content": {
        name: {"schema": {"type": "string"}}
        for name in ("text/plain", "application/openmetrics-text")
    }}},
)  # fmt: skip
async def metrics(request: Request) -> Response:
    """For whoever asks from this machine, and with the scope ``admin`` from elsewhere."""
    address = address_of(request.scope)
    if address is None or not address.is_loopback:
        authorize(request, "admin")
    encode, media_type = choose_encoder(request.headers.get("accept", ""))
    found: Any = request.app.state.metrics
    return Response(encode(found.collectors), headers={"Content-Type": media_type})
