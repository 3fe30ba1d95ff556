"""H.264 videos by ffmpeg, whose failure is told in one line."""

import os
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import IO

import imageio_ffmpeg

from mjsim.pictures.frames import FPS, Frame

_CHOICE = "IMAGEIO_FFMPEG_EXE"  # variable by which imageio_ffmpeg takes another ffmpeg


class Encoder:
    """One video, written frame by frame by mediapy; a context.

    Args:
        path: of the file.
        columns, lines: of a frame, even.
        quality: constant rate factor of x264.

    Raises:
        OSError: ffmpeg cannot write it.
    """

    def __init__(self, path: Path, columns: int, lines: int, quality: int) -> None:
        import mediapy  # brings IPython, which takes time

        mediapy.set_ffmpeg(imageio_ffmpeg.get_ffmpeg_exe())
        self._video = mediapy.VideoWriter(path, (lines, columns), fps=FPS, crf=quality)
        self._path, self._ended = path, False

    def add(self, frame: Frame) -> None:
        """Write a frame, (lines, columns, 3)."""
        try:
            self._video.add_image(frame)
        except OSError as error:
            raise self._failure() or error from None

    def __enter__(self) -> "Encoder":
        try:
            self._video.__enter__()
        except (OSError, RuntimeError) as error:  # none is installed, or it is no program
            raise OSError(f"ffmpeg cannot be started: {error}{_hint()}") from error
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:  # fmt: skip
        failure = self._failure()
        if kind is None:
            if failure:
                raise failure
            _check_written(self._path)

    def _failure(self) -> OSError | None:
        """End ffmpeg; why it failed, if it did."""
        if self._ended:
            return None
        self._ended = True
        for _ in range(2):  # first what is left of frames, which it may not take
            try:
                self._video.close()
            except OSError:
                continue
            except RuntimeError as error:
                process = self._video._popen
                if process is not None:
                    process.__exit__(None, None, None)
                return _failed(str(error).partition(": ")[2])
            break
        return None


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
            raise _failed(errors.read().decode(errors="replace"))
    _check_written(path)


def _check_written(path: Path) -> None:
    """Raise OSError for a file that a program in ffmpeg's place left without a video."""
    if not (path.is_file() and path.stat().st_size):
        raise _failed("it wrote nothing")


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


def _failed(words: str) -> OSError:
    lines = words.strip().splitlines()
    why = lines[0] if lines else "it ended without a message"
    return OSError(f"ffmpeg failed: {why}{_hint()}")


def _hint() -> str:
    choice = os.environ.get(_CHOICE)
    return f" ({_CHOICE} is {choice!r})" if choice else ""
