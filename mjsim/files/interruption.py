"""Ctrl-C: one line and exit code 130, at any moment of a command.

Python raises KeyboardInterrupt between any two instructions. In the middle of an import libraries
swallow it, or make an ImportError of it; in a destructor or a callback of a weak reference it is
printed and lost. There it comes a moment later, when it can end what it is meant to end. This
module imports nothing that takes time, so that it is there before all that does.
"""

import contextlib
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from types import FrameType

BAD_INPUT, INTERRUPTED, NO_READER = 2, 130, 141  # exit codes
_AGAIN = 0.02  # s until it is tried again; chosen
_PATIENCE = 3.0  # s that it is put off at most; chosen
_TWICE = 1.0  # s in which it counts as the same one; chosen
_IMPORT = "<frozen importlib._bootstrap>"  # file of the frames of an import
_LOSES = ("__del__", "_remove", "weakref_cb")  # functions out of which no exception gets
_TIMER = hasattr(signal, "setitimer")  # not on Windows


class _Interruption:
    """Handler of SIGINT.

    Attributes:
        held: how many blocks are not to be interrupted.
        since: when it was first asked for, or None [s].
        raised: when it was raised last [s].
    """

    def __init__(self) -> None:
        self.held = 0
        self.since: float | None = None
        self.raised = -_TWICE

    def __call__(self, number: int, frame: FrameType | None) -> None:
        now = time.monotonic()
        if now - self.raised < _TWICE:
            return
        self.since = now if self.since is None else self.since
        if _TIMER and now - self.since < _PATIENCE and (self.held or _is_lost_in(frame)):
            signal.setitimer(signal.ITIMER_REAL, _AGAIN)
            return
        self.raised, self.since = now, None
        raise KeyboardInterrupt

    def lost(self, what: "sys.UnraisableHookArgs") -> None:
        """Try it again where it was raised in a function out of which no exception gets."""
        awaited = signal.getsignal(signal.SIGINT) is self
        if _TIMER and awaited and isinstance(what.exc_value, KeyboardInterrupt):
            self.raised, self.since = -_TWICE, time.monotonic()
            signal.setitimer(signal.ITIMER_REAL, _AGAIN)
        else:
            sys.__unraisablehook__(what)


_handler = _Interruption()


def _is_lost_in(frame: FrameType | None) -> bool:
    """Tell whether an exception would not get out of a frame as it is."""
    while frame is not None:
        code = frame.f_code
        if code.co_filename == _IMPORT or code.co_name in _LOSES:
            return True
        frame = frame.f_back
    return False


@contextlib.contextmanager
def uninterrupted() -> Iterator[None]:
    """Put Ctrl-C off to the end of a short block that must not be left in its middle."""
    _handler.held += 1
    try:
        yield
    finally:
        _handler.held -= 1


@contextlib.contextmanager
def not_inherited() -> Iterator[None]:
    """Start processes that Ctrl-C in a terminal does not reach: this one ends them."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def guarded(program: str, command: Callable[[], int]) -> int:
    """Call a command; one line where it is interrupted, or a file or the output cannot be written.

    Args:
        program: name of the command.
        command: function that returns its exit code; words of its KeyboardInterrupt are printed.
    """
    unraisable = sys.unraisablehook
    try:
        if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:  # as of a command under nohup
            signal.signal(signal.SIGINT, _handler)
            if _TIMER:
                signal.signal(signal.SIGALRM, _handler)
            sys.unraisablehook = _handler.lost
        code = command()
        sys.stdout.flush()
    except KeyboardInterrupt as stop:
        return _interrupted(program, str(stop))
    except Exception as error:
        if _handler.since is not None:  # put off, and come to this in the meantime
            return _interrupted(program)
        if not isinstance(error, OSError):
            raise
        _ignore()
        if isinstance(error, BrokenPipeError):
            _end(program)
            return NO_READER
        _end(program, f"error: {_told(error)}")
        return BAD_INPUT
    finally:
        _ignore()  # what is left is the end of the process
        sys.unraisablehook = unraisable
    return code


def _interrupted(program: str, words: str = "") -> int:
    _ignore()
    _end(program, f"interrupted; {words}" if words else "interrupted")
    return INTERRUPTED


def _told(error: OSError) -> str:
    """Words of an error; what names no file is of the output, as that of files names them."""
    if error.errno is None or error.filename:
        return str(error)
    return f"the output cannot be written: {error.strerror}"


def _ignore() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if _TIMER:
        signal.setitimer(signal.ITIMER_REAL, 0.0)


def _end(program: str, line: str = "") -> None:
    """Print what is left to stdout, and a line to stderr."""
    try:
        sys.stdout.flush()
    except OSError as error:
        line = line and f"error: {_told(error)}"
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if line:
        with contextlib.suppress(OSError):
            print(f"{program}: {line}", file=sys.stderr)
