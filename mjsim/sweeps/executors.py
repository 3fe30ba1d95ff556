"""Workers of a sweep: processes of this machine, or a Dask cluster."""

import logging
import os
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from typing import Any, Protocol

from mjsim.files.extras import optional
from mjsim.files.plugins import Carried, adopt, carried, processes
from mjsim.files.processes import Pool

_PATIENCE = "10s"  # for a scheduler to answer


class LostError(RuntimeError):
    """The cluster is gone."""


class Workers(Protocol):
    """Executor of functions in other processes."""

    @property
    def count(self) -> int:
        """Number of jobs at a time."""
        ...

    def submit(self, work: Callable[[Any], Any], job: Any) -> "Future[Any]":
        """Start a job."""
        ...

    def check(self) -> None:
        """Raise LostError if the workers are gone."""
        ...

    def restart(self) -> None:
        """Replace processes that died."""
        ...

    def close(self) -> None:
        """Stop the jobs that still run."""
        ...


class Processes:
    """Processes of this machine, one per core if no number is given."""

    def __init__(self, count: int | None = None) -> None:
        self._count = count or os.cpu_count() or 1
        self._pool = self._new()

    @property
    def count(self) -> int:
        """See Workers.count."""
        return self._count

    def _new(self) -> Pool:
        return processes("mjsim.sweeps.rows", self._count, _silence)

    def submit(self, work: Callable[[Any], Any], job: Any) -> "Future[Any]":
        """See Workers.submit."""
        return self._pool.submit(work, job)

    def check(self) -> None:
        """See Workers.check: futures tell of broken processes."""

    def restart(self) -> None:
        """See Workers.restart."""
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._pool = self._new()

    def close(self) -> None:
        """See Workers.close."""
        self._pool.stop()


class Cluster:
    """Workers of a Dask scheduler, started by `dask worker`.

    Args:
        address: of the scheduler, as tcp://host:8786.

    Raises:
        ModuleNotFoundError: Dask is not installed.
        ValueError: no scheduler answers there.
    """

    def __init__(self, address: str) -> None:
        client = optional("distributed", "a scheduler").Client
        for name in ("distributed", "distributed.client", "distributed.comm", "tornado"):
            logging.getLogger(name).setLevel(logging.CRITICAL)  # LostError says it in one line
        try:
            self._client: Any = client(address, timeout=_PATIENCE, set_as_default=False)
        except (OSError, ValueError) as error:
            raise ValueError(f"no scheduler answers at {address!r}: {error}") from error
        self._executor = self._client.get_executor(pure=False)

    @property
    def count(self) -> int:
        """Threads of all workers now; one at least, for those to come."""
        try:
            return max(1, sum(self._client.nthreads().values()))
        except (OSError, RuntimeError, CancelledError):
            return 1

    def submit(self, work: Callable[[Any], Any], job: Any) -> "Future[Any]":
        """See Workers.submit."""
        return self._executor.submit(_adopting, carried(), work, job)

    def check(self) -> None:
        """See Workers.check."""
        if self._client.status != "running":
            raise LostError("the scheduler is gone")

    def restart(self) -> None:
        """See Workers.restart: Dask's nannies do it."""

    def close(self) -> None:
        """See Workers.close."""
        self._client.close(timeout=2)


def _adopting(registered: Carried, work: Callable[[Any], Any], job: Any) -> Any:
    """Work with the laws and bodies of the driver, in a process that it did not start."""
    adopt(registered)
    return work(job)


def _silence() -> None:
    """Silence warnings of divergence, and notes on files, which the driver prints."""
    logging.getLogger("absl").setLevel(logging.ERROR)
    logging.getLogger("mjsim").setLevel(logging.ERROR)
