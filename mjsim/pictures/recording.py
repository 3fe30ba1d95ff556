"""Videos of walks: one each, and several above each other in step.

Every walk is drawn once, in a process of its own; the video of several is put together from the
frames that exist.
"""

import multiprocessing
import os
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack
from pathlib import Path

import numpy as np

from mjsim.files.files import whole
from mjsim.files.processes import Pool
from mjsim.pictures.ffmpeg import Encoder, stack
from mjsim.pictures.frames import HEIGHT, WIDTH, Frame, Times, frame_times, how_much_faster
from mjsim.pictures.limb_film import LimbCamera
from mjsim.pictures.limb_overlay import LimbOverlay
from mjsim.pictures.overlay import Overlay, StripOverlay
from mjsim.pictures.render import Camera
from mjsim.results.trajectory import Trajectory

_BAND = slice(148, 568)  # lines of a frame that a band shows, between the sky and the slab
_QUALITY, _IN_SPACE = 27, 31  # x264's constant rate factor: 12 s stay under 500 KB
_BAND_QUALITY = 12  # of bands, which are encoded once more
_BAND_SCALE = 1.1  # of letters in a band
_JOINT_WIDTH, _JOINT_QUALITY = 852, 29


Gaits = Sequence[str] | None


def film(
    walks: Sequence[Trajectory], paths: Sequence[Path], joint: Path | None = None,
    gaits: Sequence[Gaits] | None = None,
) -> None:  # fmt: skip
    """Write an H.264 video of each walk; each appears under its name only when it is whole.

    Needs MUJOCO_GL to name a backend that renders, see mjsim.pictures.gl.

    Args:
        walks: the walks.
        paths: of their videos.
        joint: of a video of all of them, strips, above each other in step; none if None.
        gaits: for each walk, the names of the gaits that a policy played after each step, (T,);
            the scenes' if None.

    Raises:
        OSError: a video cannot be written.
    """
    if not walks:
        return
    until = max(float(walk.time[-1]) for walk in walks)
    with tempfile.TemporaryDirectory() as folder, ExitStack() as unfinished:
        bands = [Path(folder) / f"{i}.mp4" if joint else None for i in range(len(walks))]
        # their files are this process's, which removes them if it ends the others
        each = [unfinished.enter_context(ExitStack()) for _ in paths]
        parts = [files.enter_context(whole(path)) for files, path in zip(each, paths, strict=True)]
        played = gaits or [None] * len(walks)
        jobs = list(zip(walks, parts, bands, [until] * len(walks), played, strict=True))
        # never in this process, which may have imported mujoco without OpenGL
        context = multiprocessing.get_context("spawn")
        workers = min(len(walks), os.cpu_count() or 1)
        with Pool(workers, context) as pool:
            futures = [pool.submit(_draw, *job) for job in jobs]
            try:
                for future, files in zip(futures, each, strict=True):
                    future.result()
                    files.close()
            except BrokenProcessPool as error:
                raise OSError("the process that drew it was killed") from error
        if joint:
            with whole(joint) as part:
                stack([band for band in bands if band], part, _JOINT_WIDTH, _JOINT_QUALITY)


def write_video(walk: Trajectory, path: Path) -> int:
    """Write a video of one walk in this process; returns the number of frames."""
    with whole(path) as part:
        return _draw(walk, part, None, float(walk.time[-1]))


def pictures(walk: Trajectory, times: Times) -> Iterator[tuple[Frame, int]]:
    """Pictures of a walk without anything written on them, and the step that each shows."""
    shown, frame = -1, np.empty(0, np.uint8)
    in_space = walk.scene.in_space
    with LimbCamera(walk) if in_space else Camera(walk, WIDTH, HEIGHT) as camera:
        for time in times:
            step = int(np.clip(np.searchsorted(walk.time, time), 0, len(walk.time) - 1))
            step = max(step, walk.start)  # still until the first cycle
            if step != shown:
                shown, frame = step, camera.frame(step)
            yield frame, step


def written(walk: Trajectory, times: Times, scale: float = 1.0) -> list[Frame]:
    """Pictures of a walk with the state written on them, in letters so many times as large."""
    overlay = overlay_of(walk, scale)
    return [overlay.draw(frame, step) for frame, step in pictures(walk, times)]


def overlay_of(
    walk: Trajectory, scale: float = 1.0, faster: float = 1.0, gaits: Gaits = None
) -> Overlay:
    """The overlay of a walk, by the kind of its robot; see mjsim.pictures.overlay.Overlay."""
    kind = LimbOverlay if walk.scene.in_space else StripOverlay
    return kind(walk, scale, faster, gaits)


def _draw(
    walk: Trajectory, path: Path, band: Path | None, until: float, gaits: Gaits = None
) -> int:
    """Write the video of a walk, shown until a time [s], and its band; the number of frames."""
    in_space = walk.scene.in_space
    end = float(walk.time[-1]) if in_space else until
    faster = how_much_faster(end)
    times = frame_times(end, faster)
    overlay, small = (overlay_of(walk, scale, faster, gaits) for scale in (1.0, _BAND_SCALE))
    with ExitStack() as videos:
        video = videos.enter_context(
            Encoder(path, WIDTH, HEIGHT, _IN_SPACE if in_space else _QUALITY)
        )
        narrow = band and videos.enter_context(
            Encoder(band, WIDTH, _BAND.stop - _BAND.start, _BAND_QUALITY)
        )
        for frame, step in pictures(walk, times):
            video.add(overlay.draw(frame, step))
            if narrow:
                narrow.add(small.draw(frame[_BAND], step))
    return len(times)
