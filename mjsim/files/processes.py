"""Processes that inherit neither threads nor OpenGL, and end when their work is not wanted."""

import contextlib
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection
from multiprocessing.context import BaseContext
from types import TracebackType
from typing import Any

from mjsim.files.interruption import not_inherited, uninterrupted


def clean_start(*modules: str) -> BaseContext:
    """Context of a pool: a server that imports modules once for all, or on Windows a new process.

    Args:
        modules: names of the modules that every process will use.
    """
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    from multiprocessing import forkserver

    context = multiprocessing.get_context("forkserver")
    if modules:
        context.set_forkserver_preload(list(modules))
    with _apart():
        forkserver.ensure_running()
    return context


@contextlib.contextmanager
def _apart() -> Iterator[None]:
    """Start processes out of the reach of Ctrl-C, and whole."""
    resource_tracker.ensure_running()  # as it lets Ctrl-C through once it has started
    with not_inherited(), uninterrupted():  # other threads of this process may catch it
        yield


class Pool(ProcessPoolExecutor):
    """Processes that Ctrl-C in a terminal does not reach, and that do not outlive this one.

    Left by an error, Ctrl-C among them, it ends them at once, and waits for nothing.

    Args:
        count: number of processes; one per core if None.
        context: how they are started.
        begin: function that each calls first, with arguments.
    """

    def __init__(
        self, count: int | None, context: BaseContext, begin: Callable[..., None] | None = None,
        *arguments: Any,
    ) -> None:  # fmt: skip
        # at its end when this process ends, by kill too
        watched, self._alive = context.Pipe(duplex=False)
        super().__init__(
            count or os.cpu_count(), mp_context=context, initializer=_begin,
            initargs=(watched, begin, arguments),
        )  # fmt: skip

    def submit(self, *words: Any, **named: Any) -> Any:
        """See concurrent.futures.Executor.submit."""
        with _apart():
            return super().submit(*words, **named)

    def stop(self) -> None:
        """End the processes, whatever they do."""
        self._alive.close()
        self.shutdown(wait=True, cancel_futures=True)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:  # fmt: skip
        if kind is None:
            self.shutdown()
        else:
            self.stop()


def _begin(watched: Connection, begin: Callable[..., None] | None, arguments: Any) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(os, "setpgrp"):
        os.setpgrp()  # a group of its own, with what it starts
    threading.Thread(target=_end_with, args=(watched,), daemon=True).start()
    if begin is not None:
        begin(*arguments)


def _end_with(watched: Connection) -> None:
    """End this process, and what it started, when nobody is at the other end of a pipe."""
    watched.poll(None)
    if hasattr(os, "killpg"):
        os.killpg(0, signal.SIGKILL)
    os._exit(1)
