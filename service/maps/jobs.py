"""Jobs over HTTP at ``/v1/jobs``: whole files become maps, with progress."""

from __future__ import annotations

import asyncio
import contextlib
from collections import OrderedDict
from dataclasses import dataclass, replace
from pathlib import Path
from secrets import token_hex
from typing import Annotated, Literal, cast

from fastapi import APIRouter, Depends, Query, Request, Response

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers import read_landmarks
from symboslam.errors import SymboSlamError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.service.auth import CanIngest, CanQuery
from symboslam.service.dependencies import CurrentSettings
from symboslam.service.json_body import unsupported
from symboslam.service.maps import openapi
from symboslam.service.maps.maps import Maps
from symboslam.service.maps.models import JobInfo, Options
from symboslam.service.maps.routes import CurrentMaps, options_of
from symboslam.service.openapi import made
from symboslam.service.problems import Problem
from symboslam.service.requests import body_to_file, media_type
from symboslam.service.vocabulary import ANY_FILE, FILES

router = APIRouter(prefix="/v1/jobs", tags=["Jobs"])
_KEPT = 1000
_AT_A_TIME = 1
_MOST_WAITING = 8
_BOX = r"^-?\d+(\.\d+)?(,-?\d+(\.\d+)?){3}$"


@dataclass
class Job:
    """A file that becomes a map.

    Attributes:
        info: how far it is.
        file: what was sent.
    """

    info: JobInfo
    file: Path


class Jobs:
    """The jobs of a service, one at a time; they end with it.

    Args:
        maps: where the maps go.
        folder: for the files while they are worked on.
    """

    def __init__(self, maps: Maps, folder: Path) -> None:
        self._maps, self.folder = maps, folder
        self._jobs: OrderedDict[str, Job] = OrderedDict()
        self._turn = asyncio.Semaphore(_AT_A_TIME)
        self._tasks: set[asyncio.Task[None]] = set()
        folder.mkdir(parents=True, exist_ok=True)
        for left in folder.iterdir():
            left.unlink()

    def all(self) -> list[Job]:
        """The last jobs, the oldest first."""
        return list(self._jobs.values())

    def find(self, identifier: str) -> Job | None:
        """A job, or None."""
        return self._jobs.get(identifier)

    @property
    def waiting(self) -> int:
        """How many are not done."""
        return len(self._tasks)

    def start(
        self, file: Path, name: str, wanted: Options, format: str, crs: str | None,
        bbox: list[float] | None,
    ) -> Job:  # fmt: skip
        """Begin a job."""
        identifier = token_hex(6)
        job = Job(
            JobInfo(
                id=identifier, state="running", stage="waiting", share=0, map=None, problem=None
            ),
            file,
        )
        self._jobs[identifier] = job
        while len(self._jobs) > _KEPT:
            self._jobs.popitem(last=False)
        task = asyncio.create_task(self._run(job, name, wanted, format, crs, bbox))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return job

    async def stop(self) -> None:
        """End all jobs; what is not done leaves no trace."""
        for task in self._tasks:
            task.cancel()
        if self._tasks:
            await asyncio.wait(self._tasks)

    async def _run(
        self, job: Job, name: str, wanted: Options, format: str, crs: str | None,
        bbox: list[float] | None,
    ) -> None:  # fmt: skip
        def tell(stage: str, share: float) -> None:
            job.info = job.info.model_copy(update={"stage": stage, "share": round(share, 3)})

        def read(knowledge: Knowledge) -> LandmarkMap:
            with job.file.open("rb") as stream:
                found = read_landmarks(
                    stream, knowledge, format=format, crs=crs, bbox=bbox, progress=tell
                )
            return replace(found, report=replace(found.report, source=name))

        try:
            async with self._turn:
                options = await options_of(wanted, self._maps)
                knowledge = await self._maps.knowledge(options["ontology"])
                area = await asyncio.to_thread(read, knowledge)
                tell("classifying", 0.0)
                options |= {"source": name, "attribution": area.report.attribution}
                running = await self._maps.create(name, area, options)
            done = {"state": "done", "stage": "done", "share": 1.0, "map": running.record.id}
            job.info = job.info.model_copy(update=done)
        except SymboSlamError as error:
            problem = str(error).replace(str(job.file), name)
            job.info = job.info.model_copy(update={"state": "failed", "problem": problem})
        except Exception:
            told = "the service has a defect; its log says more"
            job.info = job.info.model_copy(update={"state": "failed", "problem": told})
            raise
        finally:
            with contextlib.suppress(OSError):
                job.file.unlink(missing_ok=True)


async def _jobs(request: Request) -> Jobs:
    return cast(Jobs, request.app.state.jobs)


CurrentJobs = Annotated[Jobs, Depends(_jobs)]


@router.post(
    "", status_code=202, summary="Classify a file", responses=made("The job.", 202), **openapi.FILE
)
async def start_job(
    request: Request,
    maps: CurrentMaps,
    jobs: CurrentJobs,
    settings: CurrentSettings,
    response: Response,
    _: CanIngest,
    name: Annotated[str, Query(min_length=1, max_length=200, pattern=openapi.TEXT)],
    format: Literal["geojson", "csv", "osm"],
    crs: Annotated[str | None, Query(max_length=200)] = None,
    bbox: Annotated[
        str | None, Query(max_length=200, pattern=_BOX, examples=["149.1,-35.3,149.2,-35.2"])
    ] = None,
    profile: Literal["default", "paper"] = "default",
    scheme: Annotated[str | None, Query(max_length=200)] = None,
    ontology: Annotated[str | None, Query(max_length=2000)] = None,
) -> JobInfo:
    """Make a map of a whole file of landmarks: the body, in any format that is read here.

    A `Content-Type` has to agree with `format`; `application/octet-stream` always does.

    The response says where its progress is told.
    """
    if jobs.waiting >= _MOST_WAITING:
        detail = f"{jobs.waiting} files are waiting already"
        raise Problem(429, "too-many-files", detail, headers={"Retry-After": "10"})
    kind, _message = media_type(request.headers.get("content-type"))
    if kind and kind not in (known := (*FILES[format], *ANY_FILE)):
        raise unsupported(kind, known)
    file = jobs.folder / token_hex(8)
    try:
        await body_to_file(request, file, settings.max_body_bytes)
    except BaseException:
        file.unlink(missing_ok=True)
        raise
    if not file.stat().st_size:
        file.unlink()
        raise Problem(422, "empty-file", "body: there is nothing in it; send the file as the body")
    wanted = Options(profile=profile, scheme=scheme, ontology=ontology)
    job = jobs.start(file, name, wanted, format, crs, _box(bbox))
    response.headers["Location"] = f"/v1/jobs/{job.info.id}"
    return job.info


@router.get("", summary="The last jobs")
async def list_jobs(jobs: CurrentJobs, _: CanQuery) -> list[JobInfo]:
    """The jobs since the service was started, the oldest first; of very many the last ones."""
    return [job.info for job in jobs.all()]


@router.get("/{job_id}", summary="How far is it?")
async def get_job(jobs: CurrentJobs, job_id: str, _: CanQuery) -> JobInfo:
    """How far a job is, and where its map is."""
    job = jobs.find(job_id)
    if job is None:
        raise Problem(404, "no-such-job", f"there is no job {job_id[:80]!r}")
    return job.info


def _box(text: str | None) -> list[float] | None:
    return None if text is None else [float(part) for part in text.split(",")]
