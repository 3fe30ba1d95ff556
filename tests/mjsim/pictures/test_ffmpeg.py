"""A broken ffmpeg is told in one line that names it."""

import os

import numpy as np
import pytest

from mjsim.pictures.ffmpeg import Encoder, stack

FRAME = np.zeros((64, 96, 3), np.uint8)


def encode(path, count=40):
    with Encoder(path, 96, 64, 30) as video:
        for _ in range(count):
            video.add(FRAME)


@pytest.mark.parametrize(
    ("program", "why"),
    [
        ("/bin/false", "ffmpeg failed: it ended without a message"),
        ("/no/ffmpeg", "ffmpeg cannot be started: .*(No such file|not found)"),
        ("/", "ffmpeg cannot be started: .*(Permission denied|not found)"),
    ],
)
def test_another_program_in_its_place_is_named(program, why, tmp_path, monkeypatch):
    monkeypatch.setenv("IMAGEIO_FFMPEG_EXE", program)
    for write in (encode, lambda path: stack([path], path, 96, 30)):
        with pytest.raises(OSError, match=why) as caught:
            write(tmp_path / "x.mp4")
        assert f"(IMAGEIO_FFMPEG_EXE is '{program}')" in str(caught.value)
        assert "\n" not in str(caught.value)


@pytest.mark.skipif(os.name != "posix", reason="a script of a shell stands for ffmpeg")
def test_a_program_that_writes_nothing_is_not_believed(tmp_path, monkeypatch):
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\ncat > /dev/null\n")
    program.chmod(0o755)
    monkeypatch.setenv("IMAGEIO_FFMPEG_EXE", str(program))
    for write in (encode, lambda path: stack([path], path, 96, 30)):
        (tmp_path / "x.mp4").touch()
        with pytest.raises(OSError, match="ffmpeg failed: it wrote nothing"):
            write(tmp_path / "x.mp4")


def test_its_own_words_are_passed_on(tmp_path):
    with pytest.raises(OSError, match=r"ffmpeg failed: .*No such file"):
        encode(tmp_path / "no folder" / "x.mp4")


def test_videos_are_stacked(tmp_path):
    encode(tmp_path / "x.mp4")
    stack([tmp_path / "x.mp4"] * 2, tmp_path / "two.mp4", 96, 30)
    assert (tmp_path / "two.mp4").stat().st_size > 500
