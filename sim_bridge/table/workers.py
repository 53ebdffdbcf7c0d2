"""Workers: missions in processes of their own, several at once, so that each has its own memory."""

from __future__ import annotations

import signal
import traceback
from collections.abc import Callable, Sequence
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from pathlib import Path

from symboslam.sim_bridge.table.area_run import note_failure, run_area
from symboslam.sim_bridge.table.plan import Plan

Tell = Callable[[str, str, float], None]


def run_all(plans: Sequence[Plan], folder: Path, jobs: int, tell: Tell) -> dict[str, str]:
    """Run missions, the longest first; a ctrl-C ends those under way and keeps the finished.

    Args:
        plans: the missions.
        folder: of the table.
        jobs: how many at once.
        tell: is told a mission's name, what it does, and the share that is done.

    Returns:
        Name -> what went wrong, of the missions that failed; the others go on.
    """
    context = get_context("spawn")
    waiting = sorted(plans, key=lambda plan: -plan.cost)
    running: dict[Connection, tuple[Plan, SpawnProcess]] = {}
    failed: dict[str, str] = {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                plan = waiting.pop(0)
                ours, theirs = context.Pipe(duplex=False)
                process = context.Process(
                    target=_work, args=(plan, folder, theirs, jobs), daemon=True
                )
                process.start()
                theirs.close()
                running[ours] = plan, process
            for connection in wait(list(running)):
                assert isinstance(connection, Connection)
                plan, process = running[connection]
                try:
                    stage, share = connection.recv()
                except EOFError:
                    stage, share = "the process ended without a word", None
                if share is not None:
                    tell(plan.name, stage, share)
                    if share < 1:
                        continue
                else:
                    failed[plan.name] = stage
                    tell(plan.name, f"failed: {stage}", 1.0)
                del running[connection]
                connection.close()
                process.join()
    finally:
        for _, process in running.values():
            process.terminate()
        for _, process in running.values():
            process.join()
    return failed


def _work(plan: Plan, folder: Path, connection: Connection, jobs: int) -> None:
    """One mission in this process; ctrl-C is its parent's business."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    import os

    from threadpoolctl import threadpool_limits

    last = ""

    def tell(stage: str, share: float) -> None:
        nonlocal last
        if stage != last:
            last = stage
            connection.send((stage, min(share, 0.999)))

    try:
        with threadpool_limits(max(1, (os.cpu_count() or 1) // jobs)):
            run_area(plan, folder, tell)
    except Exception as error:  # whatever it was: the other missions go on, and the page says it
        text = " ".join(f"{type(error).__name__}: {error}".split())
        note_failure(folder / plan.name, f"{text[:300]}\n\n{traceback.format_exc()}")
        connection.send((text[:300], None))
        return
    connection.send(("done", 1.0))
