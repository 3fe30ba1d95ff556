"""Pictures show the strip, moving the right way; the file plays."""

import re
import subprocess
import sys
from dataclasses import replace

import imageio_ffmpeg
import numpy as np
import pytest
from conftest import BACKEND
from walks import walk

from analytic import SURFACES
from mjsim.pictures import recording
from mjsim.pictures.frames import FPS
from mjsim.pictures.overlay import StripOverlay, font
from mjsim.pictures.render import Camera

pytestmark = pytest.mark.skipif(BACKEND is None, reason="no OpenGL backend on this machine")

WIDTH, HEIGHT = 640, 360


@pytest.fixture(scope="module")
def before_and_after():
    """First and last frame of a cycle on each surface, and the frame at its highest arch."""
    frames = {}
    for surface in SURFACES:
        result = walk(surface)
        start = int(np.flatnonzero(result.time <= 0)[-1])
        high = int(np.searchsorted(result.time, 5.0))
        with Camera(result, WIDTH, HEIGHT) as camera:
            frames[surface] = [camera.frame(i).copy() for i in (start, high, len(result.time) - 1)]
    return frames


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
    overlay = StripOverlay(result, 0.5)
    drawn = [overlay.draw(frame, i) for i in (0, len(result.time) // 2)]
    assert not np.array_equal(drawn[0], frame)
    assert not np.array_equal(drawn[0], drawn[1])
    assert np.array_equal(drawn[0][HEIGHT // 3 :], frame[HEIGHT // 3 :])


def test_a_green_mark_is_under_the_end_that_holds():
    """On gelatin the inflated left tip holds on the first ramp, the right one on the last."""
    result = walk("gelatin")
    with Camera(result, WIDTH, HEIGHT) as camera:
        for time, side in ((1.5, "left"), (8.5, "right")):
            step = int(np.searchsorted(result.time, time))
            frame = camera.frame(step).astype(int)
            green = (frame[..., 1] > 120) & (frame[..., 0] < 60) & (frame[..., 2] < 100)
            columns = np.flatnonzero(green.any(axis=0))
            assert green.sum() > 50
            assert (columns.mean() < WIDTH / 2) == (side == "left")


def test_the_camera_follows_a_robot_that_goes_far():
    """Slid by three lengths, it is still in the picture."""
    result = walk("gelatin")
    far = replace(result, position=np.add(result.position, [0.39, 0.0, 0.0]))
    far.position[: result.start + 1] -= [0.39, 0.0, 0.0]
    with Camera(far, WIDTH, HEIGHT) as camera:
        frame = camera.frame(len(far.time) - 1).astype(int)
    pale = (frame.min(axis=2) > 120) & (np.ptp(frame, axis=2) < 60)
    columns = np.flatnonzero(pale[HEIGHT // 2 : HEIGHT * 7 // 10].sum(axis=0) > 15)
    assert np.ptp(columns) > 0.4 * WIDTH


def test_a_video_that_fails_leaves_nothing(tmp_path, monkeypatch):
    def broken(walk, times):
        yield np.zeros((720, 1280, 3), np.uint8), 0
        raise RuntimeError("lost the context")

    monkeypatch.setattr(recording, "pictures", broken)
    with pytest.raises(RuntimeError, match="lost the context"):
        recording.write_video(walk("felt"), tmp_path / "walk.mp4")
    assert list(tmp_path.iterdir()) == []


def test_letters_of_other_alphabets_are_drawn():
    """Each differs from the box that stands for a letter that a font lacks."""
    box = np.asarray(font(24).getmask("\U000f0000"))
    for letter in "ЖψØ":
        assert not np.array_equal(np.asarray(font(24).getmask(letter)), box)


@pytest.mark.parametrize("surface", ["felt", "felt,gelatin"])
@pytest.mark.slow
def test_the_command_makes_its_videos_which_play_with_the_right_number_of_frames(tmp_path, surface):
    """From a process of its own, as a user starts it."""
    words = [sys.executable, "-m", "mjsim.run", "--surface", surface, "--links", "6",
             "--gait.ramp-time", "0.2", "--out", str(tmp_path)]  # fmt: skip
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    videos = {path.name.partition("-")[0]: path for path in tmp_path.glob("*.mp4")}
    assert sorted(videos) == (["felt"] if surface == "felt" else ["all", "felt", "gelatin"])
    frames = round(2.5 * FPS)  # 0.5 s before, 1 s of walk, 1 s after
    for name, path in videos.items():
        played = subprocess.run(
            [imageio_ffmpeg.get_ffmpeg_exe(), "-i", path, "-f", "null", "-"],
            capture_output=True, text=True, check=True,
        ).stderr  # fmt: skip
        assert "h264" in played
        assert "30 fps" in played
        assert ("1280x720" in played) == (name != "all")
        assert int(re.findall(r"frame= *(\d+)", played)[-1]) == pytest.approx(frames, abs=1)
