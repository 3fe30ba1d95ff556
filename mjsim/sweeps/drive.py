"""Loop of a sweep: keeps workers busy, stores their rows, and outlives them.

Few jobs are under way at a time, so that memory does not grow with the sweep. When a process dies,
those that were under way are run again one after the other, which shows the job that broke it. Each
scene of that job is then run alone, and a scene that breaks its process twice becomes a row with
that message.
"""

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace

from mjsim.sweeps.executors import Workers
from mjsim.sweeps.plan import Plan
from mjsim.sweeps.rows import CRASHED, Job, Row, refused, rows_of
from mjsim.sweeps.store import Store

# scenes per job: enough to be stepped as a batch, few enough to lose
_CHUNK = {
    "mujoco": 64,
    "auto": 4,
    "quasi-static": 2,
    "elastica": 8,
    "obstacle": 16,
    "lifted": 32,
    "modes": 256,
}
_AHEAD = 2  # jobs under way per worker
_STRIKES = 2  # broken processes after which a scene, run alone, is given up
_LOOK = 1.0  # s between checks of the cluster


def jobs(plan: Plan, store: Store, template: Job, workers: int = 1) -> Iterator[Job]:
    """Jobs of the scenes without a row, in order; a short plan is shared by all workers."""
    chunk = max(1, min(_CHUNK[plan.model], math.ceil(len(plan) / workers)))
    for begin in range(0, len(plan), chunk):
        numbers = store.missing(range(begin, min(begin + chunk, len(plan))))
        if numbers:
            yield replace(template, points=[(n, plan.point(n)) for n in numbers])


@dataclass
class _Task:
    """Job, whether it runs with no other beside it, and how often it then broke its process."""

    job: Job
    alone: bool = False
    strikes: int = 0


def drive(
    todo: Iterable[Job],
    workers: Workers,
    keep: Callable[[list[Row], Job], None],
    work: Callable[[Job], list[Row]] = rows_of,
) -> None:
    """Run all jobs.

    Args:
        todo: the jobs.
        workers: that run them.
        keep: function of the rows of each job, and the job.
        work: function from a job to its rows.

    Raises:
        LostError: the cluster is gone; rows so far are kept.
    """
    queue = (_Task(job) for job in todo)
    suspects: deque[_Task] = deque()
    running: dict[Future[list[Row]], _Task] = {}
    while True:
        if suspects and not running:
            task = suspects.popleft()
            running[workers.submit(work, task.job)] = task
        while not suspects and not any(task.alone for task in running.values()):
            following = next(queue, None) if len(running) < _AHEAD * workers.count else None
            if following is None:
                break
            running[workers.submit(work, following.job)] = following
        if not running:
            return
        finished, _ = wait(running, timeout=_LOOK, return_when=FIRST_COMPLETED)
        workers.check()
        broken = False
        for future in finished:
            task = running.pop(future)
            try:
                rows = future.result()
            except Exception as error:  # of a process, the work itself, or a cluster's patience
                broken = broken or isinstance(error, BrokenProcessPool)
                suspects += _after(task, error, keep)
            else:
                keep(rows, task.job)
        if broken:
            suspects += [replace(task, alone=True) for task in running.values()]
            running.clear()
            workers.restart()


def _after(task: _Task, error: Exception, keep: Callable[[list[Row], Job], None]) -> list[_Task]:
    """Tasks to be run alone after an error that is not the scene's; the last scene gets a row."""
    broken = isinstance(error, BrokenProcessPool | CancelledError)
    if broken and not task.alone:
        return [replace(task, alone=True)]
    if len(task.job.points) > 1:
        return [_Task(replace(task.job, points=[point]), alone=True) for point in task.job.points]
    if broken and task.strikes + 1 < _STRIKES:
        return [replace(task, strikes=task.strikes + 1)]
    number, _ = task.job.points[0]
    message = f"{type(error).__name__}: {error}"
    if broken:
        message = "the process that predicted it died twice"
    keep([{"id": number, **refused(message, CRASHED)}], task.job)
    return []
