"""MuJoCo's viewer on a virtual screen: the robot moves, and a slider changes the ground."""

import os
import shutil
import subprocess
import sys
import time

import numpy as np
import pytest
from PIL import ImageGrab

pytestmark = [
    pytest.mark.skipif(shutil.which("Xvfb") is None, reason="Xvfb is not installed"),
    pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed"),
]


@pytest.fixture
def screen():
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "960x600x24", "-nolisten", "tcp"],
        pass_fds=[write],
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    with os.fdopen(read) as pipe:
        name = f":{pipe.readline().strip()}"
    yield name
    server.terminate()
    server.wait()


def picture(screen):
    return np.asarray(ImageGrab.grab(xdisplay=screen)).astype(int)


def until(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.3)


@pytest.mark.slow
def test_the_robot_moves_and_a_slider_puts_it_on_other_ground(screen):
    environment = {**os.environ, "DISPLAY": screen}
    environment.pop("MUJOCO_GL", None)

    def do(*words):
        subprocess.run(["xdotool", *words], env=environment, check=True, capture_output=True)

    words = ["--surface", "gelatin", "--seconds", "20", "--numerics.links", "12"]
    words += ["--numerics.timestep", "0.02"]
    program = subprocess.Popen(
        [sys.executable, "-m", "mjsim", "view", *words],
        env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        until(lambda: picture(screen).std() > 20)
        first = picture(screen)
        time.sleep(4)
        second = picture(screen)
        changed = np.abs(first - second).sum(axis=2) > 60
        middle = changed[150:330, 50:430]  # where the strip is, not the words
        assert middle.mean() > 0.02
        red, green, _ = second[300:320, 100:300].mean(axis=(0, 1))
        assert red > 1.3 * green  # gelatin
        panel = 370  # where it begins; its width is fixed
        do("mousemove", str(panel + 117), "55", "sleep", "0.3", "click", "1", "sleep", "1")
        do("mousemove", str(panel + 135), "205", "sleep", "0.3", "mousedown", "1", "sleep", "0.5",
           "mousemove", str(panel + 187), "205", "sleep", "0.5", "mouseup", "1")  # fmt: skip

        def on_felt():
            red, green, _ = picture(screen)[300:320, 100:300].mean(axis=(0, 1))
            return green > 1.3 * red

        until(on_felt, 15)
        out, error = program.communicate(timeout=60)
    finally:
        program.kill()
    assert program.returncode == 0, error
    assert "frames per second" in out
