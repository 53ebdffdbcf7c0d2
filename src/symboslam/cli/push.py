"""``symboslam push``: send a landmark file to a service, batch by batch."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any
from urllib.parse import quote, urljoin

import typer

from symboslam.cli.client import Client, Reply, TimeoutOption, TokenOption
from symboslam.cli.common import OntologyOption, bbox_of, load_knowledge, progress_bar, show
from symboslam.errors import InputError, ServiceError

if TYPE_CHECKING:
    from symboslam.engine.landmarks import LandmarkMap
    from symboslam.reasoning.knowledge import Knowledge

EXAMPLES = """
[bold]Examples[/]

symboslam push town.geojson --to http://127.0.0.1:8080 --new Town

symboslam push drive-2.csv --to https://maps.example/town --map 7f3a --agent robot-2
"""
_MAPS = "/v1/maps"
_JSON, _GEOJSON = "application/json", "application/geo+json"


def push(
    source: Annotated[
        str,
        typer.Argument(
            metavar="FILE", help="Landmarks: GeoJSON, CSV or OpenStreetMap; - is standard input."
        ),
    ],
    to: Annotated[str, typer.Option("--to", metavar="URL", help="Address of the service.")],
    map_: Annotated[
        str | None, typer.Option("--map", metavar="ID", help="A map that is there.")
    ] = None,
    new: Annotated[
        str | None, typer.Option(metavar="NAME", help="Make a map of this name first.")
    ] = None,
    batch: Annotated[int, typer.Option(min=1, max=10_000, help="Landmarks sent at a time.")] = 500,
    agent: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Who saw the landmarks, where the file does not say."),
    ] = None,
    profile: Annotated[
        str | None, typer.Option(help="Of a new map: [bold]default[/] or [bold]paper[/].")
    ] = None,
    format_: Annotated[
        str | None,
        typer.Option("--format", help="Format of the input, where its name does not tell."),
    ] = None,
    crs: Annotated[
        str | None,
        typer.Option(help="Coordinates of the input: EPSG:..., OGC:CRS84, or m for metres."),
    ] = None,
    bbox: Annotated[
        str | None, typer.Option(metavar="W,S,E,N", help="Send what is in this area only.")
    ] = None,
    ontology: OntologyOption = None,
    token: TokenOption = None,
    timeout: TimeoutOption = 60.0,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print the address only.")] = False,
) -> None:
    """Send landmarks to a map of a service, and print the map's address.

    What has arrived already is not counted twice: after an interruption do the same again, with
    --map. Exit code 0: all of it is there; 2: the file is wrong, or the service refuses it; 3: the
    service cannot be reached or has failed.
    """
    from symboslam.engine.readers import read_landmarks

    if (map_ is None) == (new is None):
        raise InputError("give --map ID for a map that is there, or --new NAME to make one")
    client = Client(to, token, timeout)
    with progress_bar(quiet) as progress:
        knowledge = load_knowledge(ontology, progress)
        landmarks = read_landmarks(
            source, knowledge, format=format_, crs=crs, bbox=bbox_of(bbox), progress=progress
        )
        place = _there(client, map_) if map_ is not None else _made(client, landmarks, new, profile)
        told: Counter[str] = Counter()
        sent = 0
        for number, features in enumerate(_batches(landmarks, knowledge, batch, agent)):
            _send(client, place, _collection(landmarks, features), number, told)
            sent += len(features)
            progress("sending", sent / len(landmarks))
    if not quiet:
        unread = landmarks.report.unknown.total()
        show(_summary(sent, told, unread), error=True)
    typer.echo(place.address)


class _Place:
    """A map of a service.

    Args:
        path: of the map, below the service's address.
        address: of the map, for people.
    """

    def __init__(self, path: str, address: str) -> None:
        self.path, self.address = path, address


def _there(client: Client, name: str) -> _Place:
    path = f"{_MAPS}/{quote(name, safe='')}"
    return _Place(path, client.url + path)


def _made(client: Client, landmarks: LandmarkMap, name: str | None, profile: str | None) -> _Place:
    """A new map with the area of the landmarks."""
    import shapely

    wanted: dict[str, Any] = {
        "name": name,
        "bbox": _bounds(landmarks),
        "crs": None if landmarks.frame.geographic else "m",
    }
    if profile is not None:
        wanted["profile"] = profile
    if landmarks.surveyed is not None:
        frame = landmarks.frame
        outside = shapely.transform(landmarks.surveyed, frame.from_metres, interleaved=False)
        wanted["surveyed"] = json.loads(shapely.to_geojson(outside))
    reply = client.post(
        _MAPS, _dump(wanted), {"Content-Type": _JSON, "Accept": _JSON}, patient=True
    )
    found = _content(client, reply).get("id")
    if not isinstance(found, str | int):
        raise ServiceError(f"{client.url} does not say which map it has made")
    place = _there(client, str(found))
    if location := reply.headers.get("Location"):
        place.address = urljoin(client.url + _MAPS, location)
    return place


def _bounds(landmarks: LandmarkMap) -> list[float]:
    """(min x, min y, max x, max y) of the area in the input's coordinates."""
    import shapely

    west, south, east, north = landmarks.bbox
    edge = max(east - west, north - south) / 16  # borders bend on a globe
    ring = shapely.segmentize(shapely.box(*landmarks.bbox), edge or 1.0)
    outside = shapely.transform(ring, landmarks.frame.from_metres, interleaved=False)
    return [float(value) for value in shapely.bounds(outside)]


def _batches(
    landmarks: LandmarkMap, knowledge: Knowledge, size: int, agent: str | None
) -> Iterator[list[dict[str, Any]]]:
    """GeoJSON features, so many at a time."""
    first, second = landmarks.frame.from_metres(landmarks.x, landmarks.y)
    digits = 9 if landmarks.frame.geographic else 4  # less than a millimetre
    for start in range(0, len(landmarks), size):
        features = []
        for i in range(start, min(start + size, len(landmarks))):
            said: dict[str, Any] = {
                "class": knowledge.features[landmarks.feature[i]].name,
                "confidence": float(landmarks.confidence[i]),
            }
            if landmarks.time is not None and landmarks.time[i]:
                said["time"] = str(landmarks.time[i])
            by = (landmarks.agent is not None and landmarks.agent[i]) or agent
            if by:
                said["agent"] = str(by)
            position = [round(float(first[i]), digits), round(float(second[i]), digits)]
            features.append({
                "type": "Feature", "id": str(landmarks.id[i]),
                "geometry": {"type": "Point", "coordinates": position}, "properties": said,
            })  # fmt: skip
        yield features


def _collection(landmarks: LandmarkMap, features: list[dict[str, Any]]) -> dict[str, Any]:
    units = {} if landmarks.frame.geographic else {"crs_units": "m"}
    return {"type": "FeatureCollection", **units, "features": features}


def _send(
    client: Client, place: _Place, batch: dict[str, Any], number: int, told: Counter[str]
) -> None:
    """Send a batch under a name that is the same whenever the same is sent."""
    body = _dump(batch)
    headers = {
        "Content-Type": _GEOJSON, "Accept": _JSON,
        "Idempotency-Key": f"{hashlib.sha256(body).hexdigest()[:32]}-{number}",
    }  # fmt: skip
    reply = client.post(f"{place.path}/observations", body, headers, patient=True)
    said = _content(client, reply)
    for name in ("new", "merged"):
        told[name] += _count(said.get(name))
    left = said.get("left_out")
    told["left out"] += sum(map(_count, left.values())) if isinstance(left, dict) else 0


def _count(value: object) -> int:
    """A number of landmarks; 0 for what is none, and the sum of a table of them."""
    if isinstance(value, dict):
        return sum(map(_count, value.values()))
    return value if isinstance(value, int) else 0


def _content(client: Client, reply: Reply) -> dict[str, Any]:
    try:
        found = json.loads(reply.body)
    except ValueError as error:
        raise ServiceError(f"{client.url} is no SymboSLAM service: it sends no JSON") from error
    if not isinstance(found, dict):
        raise ServiceError(f"{client.url} is no SymboSLAM service")
    return found


def _dump(value: object) -> bytes:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":")).encode()


def _summary(sent: int, told: Counter[str], unread: int) -> str:
    parts = [f"sent {sent} landmarks: {told['new']} new, {told['merged']} merged"]
    if told["left out"]:
        parts.append(f"{told['left out']} left out by the service")
    if unread:
        parts.append(f"{unread} not sent, because the ontology does not know them")
    return ", ".join(parts)
