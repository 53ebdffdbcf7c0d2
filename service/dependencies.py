"""What handlers get from the app, as annotations."""

from __future__ import annotations

from typing import Annotated, cast

from fastapi import Depends, Request

from symboslam.service.settings import Settings
from symboslam.service.store._base import Store


async def _settings(request: Request) -> Settings:
    return cast(Settings, request.app.state.settings)


async def _store(request: Request) -> Store:
    return cast(Store, request.app.state.store)


CurrentSettings = Annotated[Settings, Depends(_settings)]
CurrentStore = Annotated[Store, Depends(_store)]
