"""H.264 videos by ffmpeg, whose failure is told in one line."""

import os
import subprocess
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import IO

import imageio_ffmpeg

from mjsim.pictures.frames import FPS, Frame

_CHOICE = "IMAGEIO_FFMPEG_EXE"  # variable by which imageio_ffmpeg takes another ffmpeg


class Encoder:
    """One video, written frame by frame; a context.

    Args:
        path: of the file.
        columns, lines: of a frame, even.
        quality: constant rate factor of x264.

    Raises:
        OSError: ffmpeg cannot write it.
    """

    def __init__(self, path: Path, columns: int, lines: int, quality: int) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115, closed by __exit__
        try:
            self._process = _started([
                "-v", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{columns}x{lines}",
                "-r", str(FPS), "-i", "-", "-an", *_h264(path, quality),
            ], self._errors)  # fmt: skip
        except OSError:
            self._errors.close()
            raise

    def add(self, frame: Frame) -> None:
        """Write a frame, (lines, columns, 3)."""
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(frame.tobytes())
        except OSError as error:
            raise self._failure() from error

    def __enter__(self) -> "Encoder":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:  # fmt: skip
        with self._errors:
            failure = self._failure()
        if kind is None and self._process.returncode:
            raise failure

    def _failure(self) -> OSError:
        """End ffmpeg; why it failed, if it did."""
        assert self._process.stdin is not None
        with suppress(OSError):
            self._process.stdin.close()
        self._process.wait()
        self._errors.seek(0)
        return _failed(self._process.returncode, self._errors.read())


def stack(parts: Sequence[Path], path: Path, columns: int, quality: int) -> None:
    """Write one video of several above each other.

    Raises:
        OSError: ffmpeg cannot write it.
    """
    inputs = [word for part in parts for word in ("-i", str(part))]
    stacked = f"vstack=inputs={len(parts)},scale={columns}:-2"
    with tempfile.TemporaryFile() as errors:
        process = _started(["-v", "error", *inputs, "-filter_complex", stacked,
                            *_h264(path, quality)], errors)  # fmt: skip
        process.communicate()
        errors.seek(0)
        if process.returncode:
            raise _failed(process.returncode, errors.read())


def _h264(path: Path, quality: int) -> list[str]:
    return ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", str(quality), "-y", str(path)]


def _started(words: Sequence[str], errors: IO[bytes]) -> subprocess.Popen[bytes]:
    try:
        program = imageio_ffmpeg.get_ffmpeg_exe()
        return subprocess.Popen(
            [program, *words], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=errors
        )
    except (OSError, RuntimeError) as error:  # none is installed, or it is no program
        raise OSError(f"ffmpeg cannot be started: {error}{_hint()}") from error


def _failed(code: int, errors: bytes) -> OSError:
    lines = errors.decode(errors="replace").strip().splitlines()
    why = lines[0] if lines else f"it ended with exit code {code} and without a message"
    return OSError(f"ffmpeg failed: {why}{_hint()}")


def _hint() -> str:
    choice = os.environ.get(_CHOICE)
    return f" ({_CHOICE} is {choice!r})" if choice else ""
