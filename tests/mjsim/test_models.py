"""The MJCF: what the generator writes, what the files hold, what MuJoCo makes of them."""

import mujoco
import numpy as np
import pytest

from analytic import SURFACES, Robot, Surface
from mjsim.export import documents
from mjsim.ground.textures import write_textures
from mjsim.io.assets import MODELS
from mjsim.mjcf.builder import compile_model
from mjsim.scene import Numerics, Scene


@pytest.fixture(scope="module")
def model():
    return compile_model(Scene(), Numerics(), skin=True)


@pytest.mark.parametrize(
    ("name", "text"), list(documents()), ids=lambda v: v if len(v) < 30 else ""
)
def test_the_files_are_what_the_generator_writes(name, text):
    assert (MODELS / name).read_text() == text, "run `make models`"


def test_the_textures_are_what_the_generator_draws(tmp_path):
    write_textures(tmp_path)
    from PIL import Image

    for drawn in tmp_path.iterdir():
        kept = np.asarray(Image.open(MODELS / "textures" / drawn.name), dtype=int)
        # fonts and blurs may differ by a rounding between library versions
        assert np.abs(np.asarray(Image.open(drawn), dtype=int) - kept).mean() < 1.0


@pytest.mark.parametrize("name", ["robot", *SURFACES])
def test_every_file_opens_on_its_own(name):
    model = mujoco.MjModel.from_xml_path(str(MODELS / f"{name}.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data)
    assert np.isfinite(data.qpos).all()
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_DISCRETE


@pytest.mark.parametrize("name", list(SURFACES))
def test_a_scene_carries_its_surface_s_resistances(name):
    model = mujoco.MjModel.from_xml_path(str(MODELS / f"{name}.xml"))
    surface = SURFACES[name]
    assert model.numeric("tip").data[0] == surface.tip
    assert model.numeric("area").data[0] == surface.area
    assert model.numeric("force_scale").data[0] == pytest.approx(Scene().force_scale)


def test_a_chain_of_n_links_has_n_hinges_and_three_degrees_more(model):
    assert model.nv == Numerics().links + 3


def test_the_strip_weighs_what_the_theory_says(model):
    weight = model.body("robot_link_0").subtreemass[0] * -model.opt.gravity[2]
    assert weight == pytest.approx(Robot().weight_per_length * Robot().length, rel=1e-8)  # 9 digits


def test_pads_sit_on_the_neutral_line_and_push_straight_up(model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    pads = [model.geom(f"robot_pad_{i}") for i in range(Numerics().links + 2)]
    for pad in pads:
        assert pad.condim[0] == 1
        assert pad.priority[0] == 1  # so that the ground's own softness has no say
        assert data.geom_xpos[pad.id][2] == pytest.approx(Numerics().pad_radius)
    assert data.geom_xpos[pads[0].id][0] == 0
    assert data.geom_xpos[pads[-1].id][0] == pytest.approx(Robot().length)


def test_nothing_but_pads_touches_the_ground(model):
    colliding = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    names = {model.geom(i).name for i in np.flatnonzero(colliding)}
    pads = {f"robot_pad_{i}" for i in range(Numerics().links + 2)}
    assert names == pads | {"surface_floor"}


def test_friction_tendons_read_the_ends_and_their_mean(model):
    data = mujoco.MjData(model)
    for x in (0.0, 0.02):
        data.qpos[0] = x
        mujoco.mj_forward(model, data)
        left, right, both = (data.ten_length[model.tendon(f"robot_{n}").id]
                             for n in ("left", "right", "both"))  # fmt: skip
        assert left == pytest.approx(100 + x)
        assert right == pytest.approx(100 + x + Robot().length)
        assert both == pytest.approx(left + right)


def test_any_pair_of_resistances_has_a_ground_to_walk_on():
    compile_model(Scene(surface=Surface("mud", tip=0.7, area=0.2)), Numerics(links=6))


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
