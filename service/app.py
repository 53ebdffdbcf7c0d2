"""The application: everything that the service serves."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import FastAPI
from starlette.middleware.cors import CORSMiddleware
from starlette.middleware.gzip import GZipMiddleware

from symboslam import __version__
from symboslam.service import health, problems
from symboslam.service.examples import routes as examples
from symboslam.service.page import routes as page
from symboslam.service.settings import Settings
from symboslam.service.sparql import graph_store, protocol
from symboslam.service.store._base import Store
from symboslam.service.store.oxigraph import OxigraphStore
from symboslam.service.store.seed import seed


def create_app(settings: Settings, store: Store | None = None) -> FastAPI:
    """The service as an ASGI application, which starts and stops its store.

    Args:
        settings: all that can be set.
        store: a store that is open already; by default the one of the settings is opened when
            the application starts.
    """

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        opened = store or OxigraphStore(settings)
        app.state.store = opened
        try:
            await opened.start()
            if settings.bundled_ontology:
                await seed(opened, settings.data / "ontology.sha256")
            yield
        finally:
            await opened.stop()

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
    problems.install(app)
    app.add_middleware(GZipMiddleware, minimum_size=1000, compresslevel=5)
    if settings.cors_origins:
        app.add_middleware(
            CORSMiddleware,
            allow_origins=list(settings.cors_origins),
            allow_methods=["GET", "HEAD", "POST", "PUT", "DELETE"],
            allow_headers=["Authorization", "Content-Type", "If-None-Match"],
            expose_headers=["ETag", "Location", "Retry-After"],
        )
    for router in (
        health.router, protocol.router, graph_store.router, examples.router, page.router,
    ):  # fmt: skip
        app.include_router(router)
    return app
