"""Progress of long solutions, told to whoever listens."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeVar

Row = TypeVar("Row")
Listener = Callable[[int, int], None]
"""Function of how many states are done, and of how many."""

_listener: ContextVar[Listener | None] = ContextVar("listener", default=None)


@contextmanager
def listening(listener: Listener) -> Iterator[None]:
    """Tell a function the progress of all paths that are solved for in this block."""
    token = _listener.set(listener)
    try:
        yield
    finally:
        _listener.reset(token)


def counted(rows: Sequence[Row]) -> Iterator[Row]:
    """The rows of a path, one after another, telling the listener how many are done."""
    listener = _listener.get()
    for done, row in enumerate(rows):
        if listener is not None:
            listener(done, len(rows))
        yield row
