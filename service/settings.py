"""Settings of the service: every default works, ``SYMBOSLAM_*`` in the environment changes it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, SecretStr, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

from symboslam.service.limits import parse_rates
from symboslam.service.logs import Form

MIB = 1024 * 1024
_SHORTEST_TOKEN = 16
_ENDPOINT = r"^https?://[^\s/?#@]+(/[^\s?#]*)?$"


class Settings(BaseSettings):
    """Everything that can be set; all defaults work.

    Attributes:
        data: folder of the store; made if it is not there. ``SYMBOSLAM_DATA``, and so on.
        store: the query endpoint of a SPARQL 1.1 store elsewhere; none: the store is in ``data``.
        store_update: its endpoint for updates; beside ``.../sparql`` or ``.../query`` by default.
        store_graphs: its Graph Store endpoint; beside ``.../sparql`` by default, or none.
        store_union_graphs: what to ask for as default graphs where a query is to see the union of
            all graphs, separated by commas; none: the store does it by itself.
        store_user: name for its basic authentication.
        store_password: the password.
        store_token: a bearer token in the place of both.
        admin_token: whoever sends it may do everything; 16 characters or more.
        public_read: queries need no token.
        read_only: nobody may write, whatever their token says.
        rate: requests of one client, such as ``600/minute`` or ``query=600/minute``; see `limits`.
        client_requests: requests of one client at a time.
        client_queries: queries and updates of one client at a time; by default one worker fewer
            than there are, so that others have one.
        body_seconds: how long the body of a request may take to arrive.
        drain_seconds: how long a service that stops goes on, saying that it is not ready.
        stop_seconds: how long it then waits for requests that run.
        log: ``json``, ``text`` or ``none``; by default text on a terminal, else JSON.
        log_level: the least that is logged.
        public_url: the address that clients see, where that is not the one that reaches us.
        union_default_graph: queries without a dataset of their own see the union of all graphs.
        bundled_ontology: keep the bundled ontology in the store.
        cors_origins: origins whose pages may use the service, separated by commas; ``*``: all.
        workers: processes that answer queries, so many at a time.
        quick_workers: further processes, for queries that are quick; 0: a query that takes long can
            make quick ones wait.
        worker_memory: bytes of memory that one of them may take; 0: no limit.
        query_seconds: time limit of a query.
        queue_length: queries that may wait for a worker; the next one is turned away.
        queue_seconds: how long a query may wait.
        max_query_bytes: limit of the text of a query.
        max_body_bytes: limit of an update or an uploaded graph.
        max_result_bytes: limit of a result before compression.
        allow_service: let queries ask other endpoints (``SERVICE``).
        allow_load: let updates fetch documents by HTTP (``LOAD``); files are never read.
    """

    model_config = SettingsConfigDict(env_prefix="SYMBOSLAM_", frozen=True)

    data: Path = Path("symboslam-data")
    store: str | None = Field(None, pattern=_ENDPOINT)
    store_update: str | None = Field(None, pattern=_ENDPOINT)
    store_graphs: str | None = Field(None, pattern=_ENDPOINT)
    store_union_graphs: Annotated[tuple[str, ...], NoDecode] = ()
    store_user: str | None = None
    store_password: SecretStr | None = None
    store_token: SecretStr | None = None
    admin_token: SecretStr | None = None
    public_read: bool = True
    read_only: bool = False
    rate: str = ""
    client_requests: int = Field(64, ge=1)
    client_queries: int | None = Field(None, ge=1)
    body_seconds: float = Field(60.0, gt=0)
    drain_seconds: float = Field(0.0, ge=0)
    stop_seconds: int = Field(10, ge=0)
    log: Form | None = None
    log_level: Literal["debug", "info", "warning", "error"] = "info"
    public_url: str | None = Field(None, pattern=r"^https?://[^\s?#]+$")
    union_default_graph: bool = True
    bundled_ontology: bool = True
    cors_origins: Annotated[tuple[str, ...], NoDecode] = ()
    workers: int = Field(max(2, os.cpu_count() or 2), ge=1, le=256)
    quick_workers: int = Field(2, ge=0, le=256)
    worker_memory: int = Field(1024 * MIB, ge=0)
    query_seconds: float = Field(30.0, gt=0)
    queue_length: int = Field(64, ge=0)
    queue_seconds: float = Field(10.0, ge=0)
    max_query_bytes: int = Field(MIB, gt=0)
    max_body_bytes: int = Field(64 * MIB, gt=0)
    max_result_bytes: int = Field(256 * MIB, gt=0)
    allow_service: bool = False
    allow_load: bool = False

    @field_validator("cors_origins", "store_union_graphs", mode="before")
    @classmethod
    def _split(cls, value: Any) -> Any:
        if isinstance(value, str):
            return tuple(part.strip() for part in value.split(",") if part.strip())
        return value

    @field_validator("rate")
    @classmethod
    def _is_rate(cls, value: str) -> str:
        parse_rates(value)
        return value

    @field_validator("store", "store_update", "store_graphs", "store_user", "log", mode="before")
    @classmethod
    def _unless_empty(cls, value: Any) -> Any:
        return value or None

    @field_validator("store_password", "store_token")
    @classmethod
    def _not_empty(cls, value: SecretStr | None) -> SecretStr | None:
        return value if value and value.get_secret_value() else None

    @field_validator("admin_token")
    @classmethod
    def _hard_to_guess(cls, value: SecretStr | None) -> SecretStr | None:
        length = len(value.get_secret_value()) if value else 0
        if 0 < length < _SHORTEST_TOKEN:
            raise ValueError(f"too easy to guess: give it {_SHORTEST_TOKEN} characters or more")
        return value if length else None
