"""Videos of walks: one at a time, or several stacked in step."""

import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import imageio_ffmpeg
import mediapy
import numpy as np

from mjsim.overlay import Overlay
from mjsim.render import Camera, Frame
from mjsim.trajectory import Trajectory

WIDTH, HEIGHT, FPS = 1280, 720, 30
LEAD, TAIL = 0.5, 1.0  # s of stillness before and after the walk
_QUALITY = 27  # x264's constant rate factor: a surface's 11.5 s stay under 500 KB

mediapy.set_ffmpeg(imageio_ffmpeg.get_ffmpeg_exe())


def frame_times(walk: Trajectory) -> np.ndarray:
    """Times of the frames, shape (F,) [s]."""
    return np.arange(-LEAD, float(walk.time[-1]) + TAIL, 1 / FPS)


def frames(walks: list[Trajectory]) -> Iterator[Frame]:
    """Frames of one walk, or of several above each other, all at the same time."""
    height = HEIGHT // len(walks) // 2 * 2
    view = "side" if len(walks) == 1 else "band"
    scale = 1.0 if len(walks) == 1 else 0.72
    longest = max(walks, key=lambda walk: float(walk.time[-1]))
    with ExitStack() as stack:
        cameras = [stack.enter_context(Camera(walk, WIDTH, height, view)) for walk in walks]
        overlays = [Overlay(walk, scale) for walk in walks]
        for time in frame_times(longest):
            bands = []
            for walk, camera, overlay in zip(walks, cameras, overlays, strict=True):
                step = int(np.clip(np.searchsorted(walk.time, time), 0, len(walk.time) - 1))
                bands.append(overlay.draw(camera.frame(step), step))
            yield np.concatenate(bands)


def write_video(
    walks: list[Trajectory], path: Path, progress: Callable[[int], None] | None = None
) -> int:
    """Write an H.264 video; the file appears under its name only when it is whole.

    Args:
        progress: called with 1 after each frame.

    Returns:
        The number of frames.
    """
    part = path.with_name(f".{path.stem}.part{path.suffix}")
    shape = (HEIGHT // len(walks) // 2 * 2 * len(walks), WIDTH)
    count = 0
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ResourceWarning)  # mediapy leaves ffmpeg's pipes
            with mediapy.VideoWriter(part, shape, fps=FPS, crf=_QUALITY) as writer:
                for frame in frames(walks):
                    writer.add_image(frame)
                    count += 1
                    if progress:
                        progress(1)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
    return count
