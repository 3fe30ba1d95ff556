"""The loop of a sweep: keeps workers busy, stores what they did, and outlives them.

Few jobs are under way at a time, so that memory does not grow with the sweep. When a process dies,
those that were under way are run again one after the other, so that it shows which of them did it;
of that one each scene alone, and the one that takes a process down twice becomes a row that says
so.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace

from mjsim.sweeps.executors import Workers
from mjsim.sweeps.plan import Plan
from mjsim.sweeps.rows import CRASHED, Job, Row, refused, rows_of
from mjsim.sweeps.store import Store

# scenes of a job: enough to be stepped side by side, few enough to lose
_CHUNK = {"mujoco": 64, "auto": 4, "elastica": 8, "obstacle": 16, "lifted": 32, "modes": 256}
_AHEAD = 2  # jobs a worker that are under way
_STRIKES = 2  # that a scene has, run alone
_LOOK = 1.0  # s between looks whether the cluster is still there


def jobs(plan: Plan, store: Store, template: Job) -> Iterator[Job]:
    """What is left to do, in order."""
    chunk = _CHUNK[plan.model]
    for begin in range(0, len(plan), chunk):
        numbers = store.missing(range(begin, min(begin + chunk, len(plan))))
        if numbers:
            yield replace(template, points=[(n, plan.point(n)) for n in numbers])


@dataclass
class _Task:
    """A job, whether it is run with nothing beside it, and how often it then broke its process."""

    job: Job
    alone: bool = False
    strikes: int = 0


def drive(
    todo: Iterable[Job],
    workers: Workers,
    keep: Callable[[list[Row], Job], None],
    work: Callable[[Job], list[Row]] = rows_of,
) -> None:
    """Have all jobs done.

    Args:
        todo: the jobs.
        workers: who do them.
        keep: is given the rows of each.
        work: what a worker does.

    Raises:
        LostError: the cluster is gone; what was kept is kept.
    """
    queue = (_Task(job) for job in todo)
    suspects: deque[_Task] = deque()
    running: dict[Future[list[Row]], _Task] = {}
    while True:
        if suspects and not running:
            task = suspects.popleft()
            running[workers.submit(work, task.job)] = task
        while not suspects and not any(task.alone for task in running.values()):
            next_one = next(queue, None) if len(running) < _AHEAD * workers.count else None
            if next_one is None:
                break
            running[workers.submit(work, next_one.job)] = next_one
        if not running:
            return
        finished, _ = wait(running, timeout=_LOOK, return_when=FIRST_COMPLETED)
        workers.check()
        broken = False
        for future in finished:
            task = running.pop(future)
            try:
                rows = future.result()
            except (BrokenProcessPool, CancelledError) as error:
                broken = broken or isinstance(error, BrokenProcessPool)
                suspects += _after_break(task, keep)
            except Exception as error:  # of the work itself, or a cluster's patience
                suspects += _after_error(task, error, keep)
            else:
                keep(rows, task.job)
        if broken:
            suspects += [_Task(task.job, alone=True, strikes=task.strikes)
                         for task in running.values()]  # fmt: skip
            running.clear()
            workers.restart()


def _after_break(task: _Task, keep: Callable[[list[Row], Job], None]) -> list[_Task]:
    """What is to be run alone, after the process of a task died."""
    if not task.alone:
        return [_Task(task.job, alone=True)]
    if len(task.job.points) > 1:
        return _each(task)
    if task.strikes + 1 < _STRIKES:
        return [_Task(task.job, alone=True, strikes=task.strikes + 1)]
    _give_up(task, "the process that predicted it died twice", keep)
    return []


def _after_error(
    task: _Task, error: Exception, keep: Callable[[list[Row], Job], None]
) -> list[_Task]:
    """The same after an error that is not the scene's."""
    if len(task.job.points) > 1:
        return _each(task)
    _give_up(task, f"{type(error).__name__}: {error}", keep)
    return []


def _each(task: _Task) -> list[_Task]:
    return [_Task(replace(task.job, points=[point]), alone=True) for point in task.job.points]


def _give_up(task: _Task, message: str, keep: Callable[[list[Row], Job], None]) -> None:
    number, _ = task.job.points[0]
    keep([{"id": number, **refused(message, CRASHED)}], task.job)
