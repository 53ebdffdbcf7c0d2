"""What requests of robots, and of who keeps their map, say and what they get, as JSON."""

from __future__ import annotations

from datetime import datetime

from pydantic import BaseModel, ConfigDict, Field

from symboslam.service.maps.models import LeftOut
from symboslam.service.maps.openapi import TEXT

_STRICT = ConfigDict(extra="forbid", strict=True)


class LandmarkSet(BaseModel):
    """A landmark as it is to be."""

    model_config = _STRICT

    id: str = Field(min_length=1, max_length=256, pattern=TEXT)
    class_: str | None = Field(
        default=None, alias="class", min_length=1, max_length=256, pattern=TEXT,
        description="A feature: `House`; unknown ones are counted.",
    )  # fmt: skip
    tags: dict[str, str] | None = Field(
        default=None, min_length=1, description="OpenStreetMap tags, in the place of a class."
    )
    xy: list[float] = Field(
        min_length=2, max_length=2,
        description="Metres east and north of the origin of the map, which the map tells.",
    )  # fmt: skip
    confidence: float = Field(default=1.0, gt=0, le=1)
    time: str | None = Field(
        default=None, max_length=64, description="When it was last seen: ISO 8601."
    )
    agent: str | None = Field(default=None, min_length=1, max_length=256, pattern=TEXT)
    sightings: int = Field(
        default=1, ge=1, le=10**9, description="How many observations are behind it."
    )


class LandmarksRequest(BaseModel):
    """Landmarks to set, each exactly as it is said to be, and to remove."""

    model_config = _STRICT

    set: list[LandmarkSet] = Field(default=[], max_length=100_000)
    removed: list[str] = Field(
        default=[], max_length=100_000, description="Ids; those that are not there are gone."
    )


class SettingResult(BaseModel):
    """What became of landmarks that were set."""

    batch: str
    received: int = Field(description="Landmarks to be set.")
    new: int
    changed: int = Field(description="Landmarks that were there and were set, changed or not.")
    removed: int = Field(description="Landmarks that were there and are gone.")
    left_out: LeftOut = Field(description="Not set; and removed if they were there.")
    notes: list[str]
    revision: int = Field(description="Revision of the map from which on it counts.")


class IncrementsResult(BaseModel):
    """What became of increments."""

    received: int
    new: int
    known: int = Field(description="They had been taken before.")


class RunInfo(BaseModel):
    """What is known of one run of a robot."""

    robot: str
    run: str
    increments: int
    poses: int = Field(description="Key poses in them.")
    sightings: int
    latest: int = Field(description="The highest sequence that has come.")
    missing: list[tuple[int, int]] = Field(
        description="First and last sequence of each gap below it, at most 100."
    )
    began: datetime = Field(description="When the first one came.")
    heard: datetime = Field(description="When the latest one came.")
    silent: float = Field(description="Seconds since then.")
    finished: bool = Field(description="The last one of the run is there, and all before it.")
