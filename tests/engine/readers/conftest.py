"""A feature index in a few lines, and short ways to read documents, for the readers' tests."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers import read_landmarks
from symboslam.reasoning.knowledge import Feature

FEATURES = {
    "House": ("building=house",),
    "Building": ("building=*",),
    "Tree": ("natural=tree",),
    "Bench": ("amenity=bench",),
    "Shop": ("shop=*",),
    "BusStop": ("highway=bus_stop", "public_transport=platform"),
    "Fence": ("barrier=fence",),
    "Forest": ("landuse=forest",),
    "Car": (),
}


class SmallIndex:
    """The features above; an exact tag beats a wildcard, then the first in the alphabet wins."""

    def __init__(self) -> None:
        self.features = tuple(
            Feature(f"https://example.org/{name}", name, name, static=name != "Car", osm_tags=tags)
            for name, tags in FEATURES.items()
        )
        self.tag_keys = frozenset(tag.split("=")[0] for tags in FEATURES.values() for tag in tags)
        self.matched = 0
        self._names = {name.lower(): i for i, name in enumerate(FEATURES)}
        self._tags = {tag: i for i, tags in enumerate(FEATURES.values()) for tag in tags}

    def index_of(self, name: str) -> int | None:
        return self._names.get(name.lower())

    def match_tags(self, tags: Mapping[str, str]) -> int | None:
        self.matched += 1
        for ends in ({key: f"{key}={value}" for key, value in tags.items()}, {}):
            for key in sorted(tags):
                found = self._tags.get(ends.get(key, f"{key}=*"))
                if found is not None:
                    return found
        return None


@pytest.fixture(scope="session")
def knowledge() -> SmallIndex:
    return SmallIndex()


@pytest.fixture
def names(knowledge: SmallIndex) -> Callable[[LandmarkMap], list[str]]:
    """The names of a map's features."""
    return lambda landmarks: [knowledge.features[i].name for i in landmarks.feature]


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str, Any], Path]:
    """Write text, bytes or a JSON document to a file."""

    def put(name: str, content: Any) -> Path:
        path = tmp_path / name
        if isinstance(content, bytes):
            path.write_bytes(content)
        else:
            text = content if isinstance(content, str) else json.dumps(content)
            path.write_text(text, encoding="utf-8", newline="")
        return path

    return put


@pytest.fixture
def read(knowledge: SmallIndex) -> Callable[..., LandmarkMap]:
    """``read_landmarks`` with the small index."""

    def call(source: Any, **options: Any) -> LandmarkMap:
        return read_landmarks(source, knowledge, **options)

    return call


@pytest.fixture(scope="session")
def shared() -> Path:
    """The shared data folder."""
    default = Path(__file__).resolve().parents[4] / "shared"
    folder = Path(os.environ.get("SYMBOSLAM_SHARED", default))
    if not folder.is_dir():
        pytest.skip(f"the shared data folder is not here: {folder}")
    return folder
