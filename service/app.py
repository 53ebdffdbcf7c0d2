"""The application: everything that the service serves."""

from __future__ import annotations

import asyncio
import shutil
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import Depends, FastAPI
from starlette.middleware.cors import CORSMiddleware
from starlette.middleware.gzip import GZipMiddleware

from symboslam import __version__
from symboslam.errors import StoreError
from symboslam.service import backup_api, health, metrics, openapi, problems, tokens_api
from symboslam.service.auth import Authenticator
from symboslam.service.backup import STAGING
from symboslam.service.database import check_database, lock_folder, open_database
from symboslam.service.examples import routes as examples
from symboslam.service.lifecycle import Lifecycle
from symboslam.service.limits import Limits, parse_rates
from symboslam.service.maps import agents, jobs, routes, segments
from symboslam.service.maps.jobs import Jobs
from symboslam.service.maps.mailbox import Mailbox
from symboslam.service.maps.maps import Maps
from symboslam.service.maps.records import Records
from symboslam.service.middleware import Accounts, Guard
from symboslam.service.page import routes as page
from symboslam.service.requests import known_parameters
from symboslam.service.settings import Settings
from symboslam.service.sparql import graph_store, protocol
from symboslam.service.store._base import Store
from symboslam.service.store.opening import open_store
from symboslam.service.store.seed import seed
from symboslam.service.tokens import Tokens


def create_app(settings: Settings, store: Store | None = None) -> FastAPI:
    """The service as an ASGI application, which starts and stops its store.

    Args:
        settings: all that can be set.
        store: a store that is open already; by default the one of the settings is opened when
            the application starts.

    Where the store cannot be started, ``app.state.failure`` holds the error.
    """

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        if store is None:
            await asyncio.to_thread(check_database, settings.data)
        opened = store or open_store(settings)
        locked = database = letters = None
        app.state.store = opened
        app.state.metrics.watch(opened)
        try:
            try:
                locked = lock_folder(settings.data)
                await asyncio.to_thread(shutil.rmtree, settings.data / STAGING, True)
                app.state.tokens = Tokens(settings.data)
                app.state.authenticator = Authenticator(settings, app.state.tokens)
                await opened.start()
                if settings.bundled_ontology:
                    await seed(opened)
                database = open_database(settings.data)
                app.state.maps = Maps(
                    Records(database), opened, settings.data / "ontologies", app.state.metrics
                )
                letters = open_database(settings.data)
                app.state.mailbox = Mailbox(letters)
                app.state.jobs = Jobs(app.state.maps, settings.data / "jobs")
                await app.state.maps.start()
            except StoreError as error:
                app.state.failure = error
                raise
            yield
        finally:
            for name in ("jobs", "maps"):
                if found := getattr(app.state, name, None):
                    await found.stop()
            await opened.stop()
            if tokens := getattr(app.state, "tokens", None):
                tokens.close()
            for part in (database, letters, locked):
                if part is not None:
                    part.close()

    app = FastAPI(
        title="SymboSLAM",
        version=__version__,
        summary="What kind of place each part of a map is, and why.",
        lifespan=lifespan,
        redirect_slashes=False,
        docs_url=None,  # its page comes from elsewhere on the network
        redoc_url=None,
    )
    app.state.settings = settings
    app.state.lifecycle = Lifecycle()
    app.state.backing_up = asyncio.Lock()
    app.state.limits = _limits(settings)
    app.state.metrics = metrics.Metrics()
    problems.install(app)
    openapi.install(app, public_read=settings.public_read)
    # What is added later is further out. Gzip leaves event streams alone.
    app.add_middleware(GZipMiddleware, minimum_size=1000, compresslevel=5)
    app.add_middleware(
        Guard, settings=settings, limits=app.state.limits, lifecycle=app.state.lifecycle,
        state=app.state,
    )  # fmt: skip
    if settings.cors_origins:
        app.add_middleware(
            CORSMiddleware,
            allow_origins=list(settings.cors_origins),
            allow_methods=["GET", "HEAD", "POST", "PUT", "PATCH", "DELETE"],
            allow_headers=[
                "Authorization", "Content-Type", "If-None-Match", "Last-Event-ID", "X-Request-ID",
            ],
            expose_headers=[
                "ETag", "Location", "RateLimit", "RateLimit-Policy", "Retry-After",
                "WWW-Authenticate", "X-Request-ID",
            ],
        )  # fmt: skip
    app.add_middleware(Accounts, metrics=app.state.metrics)
    for router in (
        health.router, metrics.router, protocol.router, graph_store.router, page.router,
    ):  # fmt: skip
        app.include_router(router)
    for router in (  # all that is under /v1
        tokens_api.router, routes.router, segments.router, agents.router, jobs.router,
        examples.router, backup_api.router,
    ):  # fmt: skip
        app.include_router(router, dependencies=[Depends(known_parameters)])
    return app


def _limits(settings: Settings) -> Limits:
    queries = settings.client_queries
    if queries is None and settings.workers > 1:
        queries = settings.workers - 1
    rates = parse_rates(settings.rate)
    return Limits(rates, settings.client_requests, queries, settings.queue_seconds)
