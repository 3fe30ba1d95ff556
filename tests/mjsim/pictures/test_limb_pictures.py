"""Pictures of robots of limbs: ways in words, a ruler in place, no specks; gaits played."""

from dataclasses import replace
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from conftest import BACKEND
from PIL import ImageDraw
from walks import walk

from analytic.scene.limbs import LENGTH, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES
from mjsim.model.appearance.limb_skins import CAMERA
from mjsim.pictures.camera import View, look
from mjsim.pictures.frames import how_much_faster
from mjsim.pictures.limb_overlay import LimbOverlay
from mjsim.pictures.overlay import StripOverlay
from mjsim.scene import Numerics, Scene
from studies.textures import RULER_LENGTH, RULER_START

SCENE = Scene(quadruped(), gait=undulation("wave"), ground=SURFACES["gelatin"])


@pytest.fixture
def written(monkeypatch):
    """Texts that were drawn since the test began."""
    texts = []
    draw = ImageDraw.ImageDraw.text
    monkeypatch.setattr(
        ImageDraw.ImageDraw, "text",
        lambda pen, at, text, **more: (texts.append(text), draw(pen, at, text, **more)),
    )  # fmt: skip
    return texts


@pytest.mark.parametrize(
    ("gone", "turn", "told"),
    [((-6.2, 1.3), -19.2, ["6.2 mm back", "0.046 L, 1.3 mm to the left",
                           "turned 19.2° to the right"]),
     ((4.0, -0.06), 0.3, ["4.0 mm ahead", "0.029 L, 0.1 mm to the right",
                          "turned 0.3° to the left"]),
     ((-0.04, 0.0), -0.04, ["0.0 mm", "0.000 L, 0.0 mm", "turned 0.0°"])],
)  # fmt: skip
def test_ways_are_words_and_no_minus_is_left(written, gone, turn, told):
    stub = SimpleNamespace(
        scene=SCENE, start=0, time=np.array([0.0, 1.0]), pressure=np.zeros((2, 5)),
        heading=np.radians([0.0, turn]), moved=lambda start, step: 1e-3 * np.array(gone),
    )  # fmt: skip
    LimbOverlay(stub).draw(np.zeros((720, 1280, 3), np.uint8), 1)
    assert [text for text in written if text in told] == told


def test_the_ruler_begins_at_the_hind_ends_and_lies_beside_the_robot():
    model = look(SCENE, Numerics(), 1.0).model
    ruler = model.geom("ruler")
    x, y, _ = ruler.pos
    assert 2 * ruler.size[0] == pytest.approx(RULER_LENGTH)
    # torso and legs are a third of the length each, and the torso begins at 0
    assert x - ruler.size[0] - RULER_START == pytest.approx(-LENGTH / 3)
    places = model.skin_vert  # flat and at rest
    assert y + ruler.size[1] < places.reshape(-1, 3)[:, 1].min()


def test_a_robot_that_the_ruler_does_not_suit_has_none():
    base = quadruped()
    long = [replace(limb, strip=replace(limb.strip, length=4 * limb.strip.length))
            for limb in base.limbs]  # fmt: skip
    large = replace(SCENE, robot=replace(base, limbs=tuple(long)))
    model = look(large, Numerics(), 1.0).model
    assert mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, "ruler") == -1


@pytest.mark.skipif(BACKEND is None, reason="no OpenGL backend on this machine")
def test_the_skin_has_no_specks_of_shadow():
    """With the light's shadows and without, pale skin that lies flat in the light is alike."""
    shown = look(SCENE, Numerics(), 1.0)
    mujoco.mj_forward(shown.model, shown.data)
    shown.model.skin_rgba[:, :3] = 0.0, 0.0, 1.0
    frames = []
    for shadows in (True, False):
        shown.model.light_castshadow[:] = shadows
        view = View(shown, CAMERA, 640, 360)
        view.update()
        frames.append(view.render().astype(int))
        view.close()
    dark, bright = frames
    skin = bright[..., 2] > bright[..., 0] + 60
    assert skin.sum() > 10_000
    assert (skin & ((bright - dark).sum(axis=2) > 100)).sum() < 10


def test_the_gait_that_a_policy_played_is_told(written):
    result = walk("felt")
    played = ["wave"] * len(result.time)
    played[-1] = "pulse"
    overlay = StripOverlay(result, faster=120, gaits=played)
    for step in (0, -1):
        overlay.draw(np.zeros((720, 1280, 3), np.uint8), step)
    assert "gait wave" in written
    assert "gait pulse" in written
    assert any("120 times as fast" in text for text in written)


def test_a_video_of_a_long_walk_is_short_and_of_a_usual_one_as_fast_as_the_walk():
    assert how_much_faster(10.0) == 1.0
    assert how_much_faster(1200.0) == 120.0


def test_gaits_say_which_legs_get_less():
    assert undulation("wave", left=0.7).name == "wave-left-70%"
    assert undulation("pulse", left=0.5, right=0.25).name == "pulse-left-50%-right-25%"
    assert undulation("wave").name == "wave"
