"""Pictures drawn by a process of its own, which has the OpenGL that works here.

MuJoCo reads MUJOCO_GL once, when it is imported: a process that has imported it can no longer
choose, and a second attempt at an OpenGL that failed aborts it.
"""

import os
import pickle
import subprocess
import sys
from contextlib import suppress
from functools import cache
from typing import IO, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mjsim.pictures import gl
from mjsim.pictures.frames import Frame
from mjsim.scene import Numerics, Scene

Array = NDArray[np.float64]

_PROGRAM = "from mjsim.pictures.painter import serve; serve()"
_backend = cache(gl.find_backend)


class Painter:
    """A `Still` in another process; close it, which ends that.

    Args:
        scene, numerics: what is looked at.

    Raises:
        OSError: no OpenGL renders here.
    """

    def __init__(self, scene: Scene, numerics: Numerics) -> None:
        backend = _backend()
        if backend is None:
            raise OSError(gl.HELP.replace("no video", "no picture").partition(", or pass")[0])
        path = os.pathsep.join(part for part in sys.path if part)
        environment = {**os.environ, gl.VARIABLE: backend, "PYTHONPATH": path}
        environment.pop("PYOPENGL_PLATFORM", None)
        self._process = subprocess.Popen(
            [sys.executable, "-c", _PROGRAM], env=environment,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self._send((scene, numerics))

    def draw(self, position: Array, coordinates: Array, fractions: ArrayLike) -> Frame:
        """The robot as it is, see mjsim.pictures.still.Still.draw.

        Raises:
            OSError: the process ended.
        """
        self._send((position, coordinates, np.asarray(fractions, dtype=float)))
        assert self._process.stdout is not None
        try:
            frame: Frame = pickle.load(self._process.stdout)
        except EOFError as error:
            raise self._ended() from error
        return frame

    def close(self) -> None:
        """End the process."""
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                _shut(pipe)
        self._process.wait()

    def __del__(self) -> None:
        if hasattr(self, "_process"):
            self.close()

    def _send(self, message: Any) -> None:
        assert self._process.stdin is not None
        try:
            pickle.dump(message, self._process.stdin, pickle.HIGHEST_PROTOCOL)
            self._process.stdin.flush()
        except BrokenPipeError as error:
            raise self._ended() from error

    def _ended(self) -> OSError:
        return OSError(f"the process that draws ended with code {self._process.wait()}")


def _shut(pipe: IO[bytes]) -> None:
    with suppress(BrokenPipeError):  # of what a process that ended did not read
        pipe.close()


def serve() -> None:
    """Draw what standard input says: a scene and its numerics, then states, until it closes."""
    from mjsim.pictures.still import Still

    asked, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr
    still = Still(*pickle.load(asked))
    while True:
        try:
            state = pickle.load(asked)
        except EOFError:
            break
        pickle.dump(np.ascontiguousarray(still.draw(*state)), answers, pickle.HIGHEST_PROTOCOL)
        answers.flush()
    still.close()
