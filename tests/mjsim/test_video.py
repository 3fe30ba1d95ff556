"""Pictures show the strip, moving the right way; the file plays."""

import subprocess

import imageio_ffmpeg
import numpy as np
import pytest
from conftest import BACKEND
from walks import walk

from analytic import SURFACES
from mjsim.video import recording as video
from mjsim.video.overlay import Overlay
from mjsim.video.render import Camera

pytestmark = pytest.mark.skipif(BACKEND is None, reason="no OpenGL backend on this machine")

WIDTH, HEIGHT = 640, 360


@pytest.fixture(scope="module")
def before_and_after():
    """First and last frame of a cycle on each surface, and the frame at its highest arch."""
    found = {}
    for surface in SURFACES:
        result = walk(surface)
        start = int(np.flatnonzero(result.time <= 0)[-1])
        high = int(np.searchsorted(result.time, 5.0))
        with Camera(result, WIDTH, HEIGHT) as camera:
            found[surface] = [camera.frame(i).copy() for i in (start, high, len(result.time) - 1)]
    return found


def strip_columns(frame, background):
    """Columns of the picture in which the strip hides the ground: the left edge comes first."""
    changed = np.abs(frame.astype(int) - background.astype(int)).max(axis=2) > 60
    return np.flatnonzero(changed[: HEIGHT * 2 // 3].sum(axis=0) > 3)


def test_frames_are_not_blank(before_and_after):
    for frames in before_and_after.values():
        for frame in frames:
            assert frame.shape == (HEIGHT, WIDTH, 3)
            assert frame.std() > 20
            assert len(np.unique(frame.reshape(-1, 3), axis=0)) > 1000


@pytest.mark.parametrize(("surface", "sign"), [("felt", 1), ("gelatin", -1)])
def test_the_robot_moves_the_right_way_in_pixels(before_and_after, surface, sign):
    """The right end of the pale strip lies before a darker ground; follow where it stops."""
    first, _, last = before_and_after[surface]
    difference = last.astype(int).sum(axis=2) - first.astype(int).sum(axis=2)
    right_half = difference[:, WIDTH // 2 :]
    brighter, darker = (right_half > 120).sum(), (right_half < -120).sum()
    # going right, the right end covers new ground with pale skin; going left, it bares ground
    assert sign * (int(brighter) - int(darker)) > 200


def test_the_strip_arches_above_where_it_lay(before_and_after):
    first, high, _ = before_and_after["felt"]
    changed = np.abs(high.astype(int) - first.astype(int)).max(axis=2) > 60
    rows = np.flatnonzero(changed.sum(axis=1) > 20)
    assert np.ptp(rows) > 0.2 * HEIGHT


def test_inflated_segments_are_darker_than_passive_ones(before_and_after):
    first, high, _ = before_and_after["felt"]
    dark = (first.astype(int).max(axis=2) < 70).sum(), (high.astype(int).max(axis=2) < 70).sum()
    assert dark[1] > dark[0] + 1000


def test_surfaces_look_different(before_and_after):
    corners = [frames[0][-HEIGHT // 4 :, :, :].mean(axis=(0, 1))
               for frames in before_and_after.values()]  # fmt: skip
    for i in range(3):
        assert np.abs(corners[i] - corners[i - 1]).max() > 30


def test_the_overlay_writes_pressures_and_displacement(before_and_after):
    frame = before_and_after["felt"][0]
    result = walk("felt")
    overlay = Overlay(result, 0.5)
    drawn = [overlay.draw(frame, i) for i in (0, len(result.time) // 2)]
    assert not np.array_equal(drawn[0], frame)
    assert not np.array_equal(drawn[0], drawn[1])
    assert np.array_equal(drawn[0][HEIGHT // 3 :], frame[HEIGHT // 3 :])


@pytest.mark.parametrize("count", [1, 3])
def test_the_file_plays_with_the_right_number_of_frames(tmp_path, monkeypatch, count):
    monkeypatch.setattr(video, "WIDTH", 320)
    monkeypatch.setattr(video, "HEIGHT", 180)
    walks = [walk(surface, ramp_time=0.2) for surface in list(SURFACES)[:count]]
    path = tmp_path / "walk.mp4"
    written = video.write_video(walks, path)
    # 0.5 s before, 1 s of walk, 1 s after
    assert written == pytest.approx(2.5 * video.FPS, abs=1)
    ffmpeg = imageio_ffmpeg.get_ffmpeg_exe()
    played = subprocess.run([ffmpeg, "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                            capture_output=True, check=True)  # fmt: skip
    assert len(played.stdout) == written * 320 * 180 * 3
    assert b"h264" in played.stderr
    assert b"320x180" in played.stderr
    assert b"30 fps" in played.stderr
    assert [item.name for item in tmp_path.iterdir()] == ["walk.mp4"]


def test_a_video_that_fails_leaves_nothing(tmp_path, monkeypatch):
    def broken(walks, times):
        yield np.zeros((720, 1280, 3), np.uint8)
        raise RuntimeError("lost the context")

    monkeypatch.setattr(video, "bands", broken)
    with pytest.raises(RuntimeError, match="lost the context"):
        video.write_video([walk("felt")], tmp_path / "walk.mp4")
    assert list(tmp_path.iterdir()) == []
