"""The planar body as MuJoCo has it, and its skin."""

import mujoco
import numpy as np
import pytest

from analytic import Robot
from analytic.scene.surface import from_ratios
from mjsim.model.appearance.skin import add_skins
from mjsim.model.bodies.parts import FAR, TOUCH
from mjsim.model.builder import compile_model, scene_spec
from mjsim.scene import Numerics, Scene

NUMERICS = Numerics().resolved("chain", "constant")


@pytest.fixture(scope="module")
def model():
    spec = scene_spec(Scene(), NUMERICS)
    add_skins(spec, Robot(), NUMERICS)
    return spec.compile()


def test_a_chain_of_n_links_has_n_hinges_and_three_degrees_more(model):
    assert model.nv == NUMERICS.links + 3


def test_pads_sit_on_the_neutral_line_and_push_straight_up(model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    pads = [model.geom(f"robot_pad_{i}") for i in range(NUMERICS.links + 2)]
    for pad in pads:
        assert pad.condim[0] == 1
        assert pad.priority[0] == 1  # so that the ground's own softness has no say
        height = NUMERICS.pad_radius - TOUCH * Robot().length
        assert data.geom_xpos[pad.id][2] == pytest.approx(height)
    assert data.geom_xpos[pads[0].id][0] == 0
    assert data.geom_xpos[pads[-1].id][0] == pytest.approx(Robot().length)


def test_nothing_but_pads_touches_the_ground(model):
    colliding = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    names = {model.geom(i).name for i in np.flatnonzero(colliding)}
    pads = {f"robot_pad_{i}" for i in range(NUMERICS.links + 2)}
    assert names == pads | {"surface_floor"}


def test_friction_tendons_read_the_ends_and_their_mean(model):
    data = mujoco.MjData(model)
    for x in (0.0, 0.02):
        data.qpos[0] = x
        mujoco.mj_forward(model, data)
        left, right, both = (data.ten_length[model.tendon(f"robot_{n}").id]
                             for n in ("left", "right", "both"))  # fmt: skip
        assert left == pytest.approx(FAR + x)
        assert right == pytest.approx(FAR + x + Robot().length)
        assert both == pytest.approx(left + right)


def test_any_surface_has_a_ground_to_walk_on():
    compile_model(Scene(ground=from_ratios("mud", 0.7, 0.2)), NUMERICS)


def test_skins_cover_the_strip_and_move_with_it(model):
    assert model.nskin == 3
    x = model.skin_vert[:, 0]
    assert x.min() == pytest.approx(0, abs=1e-6)
    assert x.max() == pytest.approx(Robot().length, abs=1e-6)
    weight = np.zeros(len(x))
    for skin in range(3):
        bones = range(model.skin_boneadr[skin], model.skin_boneadr[skin] + model.skin_bonenum[skin])
        for bone in bones:
            adr, num = model.skin_bonevertadr[bone], model.skin_bonevertnum[bone]
            ids = model.skin_vertadr[skin] + model.skin_bonevertid[adr : adr + num]
            weight[ids] += model.skin_bonevertweight[adr : adr + num]
    assert np.allclose(weight, 1, atol=1e-5)
