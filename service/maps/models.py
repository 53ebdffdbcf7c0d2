"""What requests about maps say and what they get, as JSON."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator

from symboslam.engine.account import Change, Difference, Side
from symboslam.engine.landmark_parts import LandmarkPart, Others, PairPart
from symboslam.reasoning.knowledge import Indication
from symboslam.service.maps.openapi import TEXT

_STRICT = ConfigDict(extra="forbid", strict=True)
Length = Literal["line", "paragraph", "full"]


class Segmentation(BaseModel):
    """How a map is cut; what is left out is as in the profile."""

    model_config = _STRICT

    method: Literal["grid"] = Field(
        default="grid",
        description="A map that is kept is cut by grid; `symboslam classify` knows others.",
    )
    cells: int | None = Field(
        default=None, ge=1, le=192, description="Finest cells along each side."
    )
    threshold: float | None = Field(
        default=None, ge=0, le=1, description="A cell is split while its largest P is below this."
    )
    min_landmarks: int | None = Field(default=None, ge=0, le=10**9)
    empty: Literal["inherit", "unknown"] | None = None

    @field_validator("method", mode="before")
    @classmethod
    def _can_be_kept(cls, method: Any) -> Any:
        if isinstance(method, str) and method != "grid":
            raise ValueError(
                f"a map that is kept is cut by grid, not by {method[:40]!r}: a fragment may change "
                "as a whole with any landmark; `symboslam classify` cuts files in other ways"
            )
        return method


class Settings(BaseModel):
    """Settings of the evidence that differ from the profile's."""

    model_config = _STRICT

    evidence: Literal["field", "pairs"] | None = None
    measure: Literal["path", "wu_palmer", "lin", "direct"] | None = None
    importance: Literal["entropy", "none"] | None = None
    a: float | None = Field(default=None, gt=0, lt=1)
    bandwidth: float | None = Field(default=None, gt=0, le=1e9, description="In metres.")
    dissimilarity: float | None = Field(default=None, ge=0, le=1)
    absence: float | None = Field(default=None, ge=0, le=1e9)


class Options(BaseModel):
    """How a map is classified."""

    model_config = _STRICT

    profile: Literal["default", "paper"] = "default"
    scheme: str | None = Field(
        default=None,
        max_length=200,
        description="Set of environment types; by default the ontology's.",
    )
    ontology: str | None = Field(
        default=None, max_length=2000,
        description="IRI of a graph in the store that holds an ontology; by default the bundled.",
    )  # fmt: skip
    segmentation: Segmentation = Segmentation()
    settings: Settings = Settings()
    merge_radius: float = Field(
        default=5.0,
        ge=0,
        le=10_000,
        description="Metres within which observations of a class are of one.",
    )
    reasons: int = Field(default=5, ge=0, le=100, description="Reasons of a segment in the store.")


class MapRequest(Options):
    """A map to make."""

    name: str = Field(min_length=1, max_length=200, pattern=TEXT)
    bbox: list[float] = Field(
        min_length=4, max_length=6, description="Min x, min y, max x, max y (west, south, ...)."
    )
    crs: str | None = Field(
        default=None, max_length=200,
        description="Of bbox and surveyed: `EPSG:...`; `m` for local metres; default OGC:CRS84.",
    )  # fmt: skip
    surveyed: dict[str, Any] | None = Field(
        default=None, description="GeoJSON geometry of what was looked at; by default the box."
    )


class MapInfo(BaseModel):
    """A map."""

    id: str
    name: str
    iri: str = Field(description="IRI of the map, the base of its graphs and of all that is in it.")
    bbox: list[float] = Field(
        description="As it was sent; else, or where it was sent in another system than `crs`, the"
        " box around the map."
    )
    crs: str
    origin: list[float] | None = Field(
        description="Longitude and latitude of the origin of the map's metres, which point east"
        " and north; null in a map of local metres, where coordinates are metres."
    )
    created: datetime
    changed: datetime
    revision: int = Field(description="How often it changed.")
    landmarks: int
    batches: int
    left_out: dict[str, int]
    environments: list[str]
    settings: dict[str, Any]
    links: dict[str, str]


class LeftOut(BaseModel):
    """What was not taken of a batch."""

    outside: int
    unknown: dict[str, int] = Field(description="Class or tags that no feature has -> how many.")


class BatchResult(BaseModel):
    """What became of a batch."""

    batch: str
    received: int
    new: int = Field(description="Observations that began a landmark.")
    merged: int = Field(description="Observations of landmarks that were known.")
    left_out: LeftOut
    notes: list[str]
    revision: int = Field(description="Revision of the map from which on it counts.")


class OverrideRequest(BaseModel):
    """An operator's statement about a segment."""

    model_config = _STRICT

    environment: str | None = Field(
        max_length=200, description="Name of an environment type; null: it is unknown."
    )
    reason: str = Field(default="", max_length=2000, pattern=TEXT)
    operator: str | None = Field(
        default=None,
        min_length=1,
        max_length=200,
        pattern=TEXT,
        description="Who says so; by default the token's name.",
    )


class OverrideInfo(BaseModel):
    """An override."""

    id: str
    segment: str
    environment: str | None
    operator: str
    reason: str
    made: datetime
    undone: datetime | None


class ReasonInfo(BaseModel):
    """What landmarks of one kind, or the open ground, add to the probabilities."""

    feature: str
    label: str
    count: int
    contribution: dict[str, float]


class ChainInfo(BaseModel):
    """The probabilities above and below environment types."""

    groups: dict[str, float]
    zones: dict[str, dict[str, float]]
    untold: list[str]


class ExplanationInfo(BaseModel):
    """Why a segment is what it is; docs/evidence.md says what each number is."""

    segment: str
    environment: str | None
    probabilities: dict[str, float]
    override: OverrideInfo | None
    text: str
    reasons: list[ReasonInfo]
    runner_up: str | None
    chain: ChainInfo | None
    why: Side | None
    against: Side | None
    difference: float | None = Field(description="P(environment) - P(against).")
    differences: list[Difference] = Field(description="They sum to `difference`.")
    landmarks: list[LandmarkPart] = Field(description="The strongest ones.")
    other_landmarks: Others | None = Field(description="Those that are not listed.")
    ground: float | None = Field(
        description="What ground without landmarks adds; with all landmarks it sums to P."
    )
    pairs: list[PairPart] = Field(description="The strongest ones.")
    other_pairs: float | None = Field(description="What all other pairs add.")
    counted: bool = Field(
        description="Whether `own` is what a landmark adds by being counted, and not by itself."
    )
    held: bool = Field(
        description="Whether `without` is what a fragment is if it is otherwise held as it is."
    )
    crs: str = Field(description="IRI of the coordinate system of positions.")
    counterfactuals: list[Change] | None = Field(description="Null unless asked for.")
    indications: list[Indication] = Field(description="The axioms behind the reasons.")


class JobInfo(BaseModel):
    """A classification of a whole file."""

    id: str
    state: Literal["running", "done", "failed"]
    stage: str
    share: float = Field(description="Of the stage, from 0 to 1.")
    map: str | None = Field(description="Id of the map, when it is done.")
    problem: str | None
