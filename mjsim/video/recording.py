"""Videos of walks: one at a time, or several stacked in step."""

import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import imageio_ffmpeg
import mediapy
import numpy as np
from numpy.typing import NDArray

from mjsim.io.files import whole
from mjsim.simulation.trajectory import Trajectory
from mjsim.video.overlay import Overlay
from mjsim.video.render import Camera, Frame

Times = NDArray[np.float64]

WIDTH, HEIGHT, FPS = 1280, 720, 30
LEAD, TAIL = 0.5, 1.0  # s of stillness before and after the walk
_QUALITY = 27  # x264's constant rate factor: a surface's 11.5 s stay under 500 KB

mediapy.set_ffmpeg(imageio_ffmpeg.get_ffmpeg_exe())


def frame_times(walks: list[Trajectory]) -> Times:
    """Times of the frames, up to the end of the longest walk and a little more, (F,) [s]."""
    last = max(float(walk.time[-1]) for walk in walks)
    return np.arange(-LEAD, last + TAIL, 1 / FPS)


def bands(walks: list[Trajectory], times: Times) -> Iterator[Frame]:
    """Pictures of one walk, or of several above each other, at each of the times."""
    height = _height(len(walks))
    view, scale = ("side", 1.0) if len(walks) == 1 else ("band", 0.72)
    with ExitStack() as stack:
        cameras = [stack.enter_context(Camera(walk, WIDTH, height, view)) for walk in walks]
        overlays = [Overlay(walk, scale) for walk in walks]
        for time in times:
            pictures = []
            for walk, camera, overlay in zip(walks, cameras, overlays, strict=True):
                step = int(np.clip(np.searchsorted(walk.time, time), 0, len(walk.time) - 1))
                pictures.append(overlay.draw(camera.frame(step), step))
            yield np.concatenate(pictures)


def _height(count: int) -> int:
    """Lines of one of `count` pictures above each other, even."""
    return HEIGHT // count // 2 * 2


def write_video(
    walks: list[Trajectory], path: Path, progress: Callable[[int], None] | None = None
) -> int:
    """Write an H.264 video; the file appears under its name only when it is whole.

    Args:
        progress: called with 1 after each frame.

    Returns:
        The number of frames.
    """
    shape = (_height(len(walks)) * len(walks), WIDTH)
    count = 0
    with whole(path) as part, warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)  # mediapy leaves ffmpeg's pipes
        with mediapy.VideoWriter(part, shape, fps=FPS, crf=_QUALITY) as writer:
            for frame in bands(walks, frame_times(walks)):
                writer.add_image(frame)
                count += 1
                if progress:
                    progress(1)
    return count
