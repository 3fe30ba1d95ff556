"""MJCF that walks by itself: in plain MuJoCo, in dm_control, in a rollout, from any folder."""

import re
import shutil

import mujoco
import numpy as np
import pytest
from mujoco import rollout

from analytic import GAITS, SURFACES, Robot
from mjsim.commands import export
from mjsim.files.assets import MODELS
from mjsim.files.command_line import cli
from mjsim.model.standalone.strips import standalone_spec, walking_scene
from mjsim.results.measures import measure
from mjsim.scene import Scene, registry
from mjsim.simulation import alone
from mjsim.simulation.simulation import simulate
from studies.textures import write_textures

STANDING = 100  # steps before the gait begins
GAIT = GAITS["wave"]


def commands(timestep):
    time = np.arange(1.0, round(GAIT.period / timestep) + 1) * timestep
    walking = Robot().peak_pressure * GAIT.fractions(time)
    return np.concatenate([np.zeros((STANDING, 3)), walking])


def by_mjsim(name):
    scene = walking_scene(Scene(ground=SURFACES[name]))
    return measure(simulate(scene)).displacement


@pytest.mark.parametrize("name", list(SURFACES))
def test_files_by_load_go_by_a_loop_of_mj_step_alone_as_far_as_mjsim(name):
    model = mujoco.MjModel.from_xml_path(str(MODELS / f"{name}_coulomb.xml"))
    data = mujoco.MjData(model)
    places = []
    for control in commands(model.opt.timestep):
        data.ctrl[:] = control
        mujoco.mj_step(model, data)
        places.append(data.sensor("left_position").data[0])
    shift = (places[-1] - places[STANDING - 1]) / Robot().length
    assert shift == pytest.approx(by_mjsim(name), rel=0.01)


@pytest.mark.parametrize("name", ["polyethylene", "gelatin"])
def test_so_does_dm_control(name):
    dm = pytest.importorskip("mjsim.env.dm_binding", exc_type=ImportError)
    physics = dm.mujoco.Physics.from_xml_path(str(MODELS / f"{name}_coulomb.xml"))
    sequence = commands(physics.timestep())
    places = []
    for control in sequence:
        physics.set_control(control)
        physics.step()
        places.append(float(physics.named.data.site_xpos["robot_end_left", "x"]))
    shift = (places[-1] - places[STANDING - 1]) / Robot().length
    assert shift == pytest.approx(by_mjsim(name), rel=0.01)


@pytest.mark.parametrize("name", ["polyethylene", "gelatin"])
def test_so_does_a_rollout(name):
    model = mujoco.MjModel.from_xml_path(str(MODELS / f"{name}_coulomb.xml"))
    data = mujoco.MjData(model)
    sequence = commands(model.opt.timestep)
    mujoco.mj_forward(model, data)
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    states, _ = rollout.rollout(model, data, state[None], sequence[None])
    x = states[0, :, 1]  # after the time; the first coordinate is x of the left end
    rolled = (x[-1] - x[STANDING - 1]) / Robot().length
    assert rolled == pytest.approx(by_mjsim(name), rel=0.01)


def test_a_robot_that_is_pushed_is_stopped_by_the_ground():
    """On felt, whose flat sides hold; two seconds after a push of 10 cm/s."""
    model = mujoco.MjModel.from_xml_path(str(MODELS / "felt_coulomb.xml"))
    data = mujoco.MjData(model)
    for _ in range(STANDING):
        mujoco.mj_step(model, data)
    data.qvel[0] = 0.1
    before = data.qpos[0]
    for _ in range(400):
        mujoco.mj_step(model, data)
    assert abs(data.qvel[0]) < 1e-4
    # by mu g, less what the two tips do not hold
    assert data.qpos[0] - before == pytest.approx(0.1**2 / (2 * 0.37 * 9.81), rel=0.2)


@pytest.mark.parametrize("name", [*SURFACES, *(f"{name}_coulomb" for name in SURFACES)])
def test_it_has_sliders_in_pascal_named_sensors_a_keyframe_and_cameras(name):
    model = mujoco.MjModel.from_xml_path(str(MODELS / f"{name}.xml"))
    assert model.nu == 3
    assert model.actuator_ctrllimited.all()
    assert model.actuator_ctrlrange[:, 1] == pytest.approx(Robot().peak_pressure, rel=1e-5)
    names = {model.sensor(i).name for i in range(model.nsensor)}
    assert {"left_position", "right_position", "left_load", "right_load"} <= names
    assert model.key("flat").qpos == pytest.approx(np.zeros(model.nq))
    assert model.camera("side").id >= 0
    assert (MODELS / f"{name}.xml").stat().st_size < 40_000


def without_measures(path):
    """All lines of a file but the one that tells what it measures, the second of its comment."""
    head, _, rest = path.read_text().partition("-->")
    return [*head.splitlines()[:-1], rest]


def test_the_files_are_those_of_the_code(tmp_path, monkeypatch):
    monkeypatch.setattr(alone, "measured", lambda *_: "")
    assert export.main(["--models", "--out", str(tmp_path)]) == 0
    for path in tmp_path.glob("*.xml"):
        assert without_measures(path) == without_measures(MODELS / path.name), "run `make models`"
    assert {path.stem for path in tmp_path.glob("*.xml")} == {
        path.stem for path in MODELS.glob("*.xml")
    }


@pytest.mark.slow
def test_so_are_the_distances_in_their_comments(tmp_path):
    assert export.main(["--models", "--out", str(tmp_path)]) == 0
    for path in tmp_path.glob("*.xml"):
        assert path.read_text() == (MODELS / path.name).read_text(), "run `make models`"


def test_each_file_names_its_law_and_what_it_measures():
    for path in MODELS.glob("*.xml"):
        head = path.read_text().partition("-->")[0]
        assert ("constant bounds at tips" in head) == (path.stem in SURFACES)
        assert ("by load (mu N)" in head) == (path.stem not in SURFACES)
        assert ("L at 2 s per ramp" in head and "L at 8 s per ramp" in head) == (
            path.stem != "rod"
        ), path  # fmt: skip


def test_the_table_of_the_readme_has_the_distances_of_the_files():
    table = (MODELS / "README.md").read_text()
    for path in MODELS.glob("*.xml"):
        told = re.findall(r"([+-]\d\.\d{3}) L at", path.read_text().partition("-->")[0])
        (row,) = [line for line in table.splitlines() if line.startswith(f"| `{path.name}` ")]
        assert re.findall(r"[+-]\d\.\d{3}", row) == told, path


@pytest.mark.slow
def test_the_last_line_names_the_law_and_what_the_file_goes(tmp_path, capsys):
    words = ["--robot.mass", "0.02", "--out", str(tmp_path)]
    for law, friction in (("constant bounds", []), ("by load (mu N)", ["--friction", "coulomb"])):
        assert export.main([*words, *friction]) == 0
        line = capsys.readouterr().err.splitlines()[-1]
        assert law in line
        assert re.search(r"[+-]0\.\d{3} L at 2 s per ramp, [+-]0\.\d{3} L at 8 s per ramp", line)


@pytest.fixture
def moved(tmp_path, monkeypatch):
    """A scene of one's own, exported and moved elsewhere."""
    monkeypatch.setattr(alone, "measured", lambda *_: "")
    scene = tmp_path / "my.toml"
    scene.write_text('[robot]\nlength = 0.09\nmass = 0.012\n[ground]\nsurface = "gelatin"\n')
    assert export.main(["--scene", str(scene), "--out", str(tmp_path / "out")]) == 0
    shutil.move(tmp_path / "out", tmp_path / "moved")
    monkeypatch.chdir("/")
    return tmp_path / "moved" / "gelatin.xml"


def test_an_exported_scene_loads_from_another_folder(moved):
    model = mujoco.MjModel.from_xml_path(str(moved))
    assert model.body_subtreemass[0] == pytest.approx(0.012, rel=1e-4)
    assert str(moved.parent.parent) not in moved.read_text()


def test_so_it_does_in_dm_control(moved):
    pytest.importorskip("mjsim.env.dm_binding", exc_type=ImportError)
    from dm_control import mjcf

    physics = mjcf.Physics.from_mjcf_model(mjcf.from_path(str(moved)))
    assert physics.model.nu == 3


@pytest.mark.parametrize("body", registry.names())
def test_every_body_can_be_exported_and_stepped(body):
    model = standalone_spec(Scene(body=body)).compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=50)
    assert np.isfinite(data.qpos).all()


def test_the_exported_cable_bends_by_its_controls():
    """Evenly inflated and free, each joint turns by its natural curvature."""
    model = mujoco.MjModel.from_xml_path(str(MODELS / "cable.xml"))
    model.opt.gravity[:] = 0
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    data = mujoco.MjData(model)
    data.ctrl[:] = 0.5 * Robot().peak_pressure
    mujoco.mj_step(model, data, nstep=600)
    balls = data.qpos[7:].reshape(-1, 4)
    turn = 2 * np.arctan2(balls[:, 2], balls[:, 0])
    expected = 3.529 / 2 / model.nu  # alpha p L of the default robot, by joint
    assert np.abs(turn) == pytest.approx(np.full(model.nu, expected), rel=0.01)
    assert (np.sign(turn) == np.sign(turn[0])).all()


def test_help_does_nothing_else(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for words in (["--help"], ["--models", "--help"]):
        with pytest.raises(SystemExit) as stop:
            export.main(words)
        assert stop.value.code == 0
    assert "--scene" in capsys.readouterr().out
    assert list(tmp_path.iterdir()) == []


def test_bad_input_gets_one_line_and_exit_2(tmp_path, capsys):
    with pytest.raises(SystemExit) as stop:
        export.main(["--surface", "ice", "--out", str(tmp_path)])
    assert stop.value.code == cli.BAD_INPUT
    assert "felt, polyethylene, gelatin" in capsys.readouterr().err


def test_the_textures_are_what_the_generator_draws(tmp_path):
    from PIL import Image

    write_textures(tmp_path)
    for drawn in tmp_path.iterdir():
        kept = np.asarray(Image.open(MODELS / "textures" / drawn.name), dtype=int)
        # fonts and blurs may differ by a rounding between library versions
        assert np.abs(np.asarray(Image.open(drawn), dtype=int) - kept).mean() < 1.0


def test_a_file_that_takes_the_place_of_another_is_told(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(alone, "measured", lambda *_: "")
    for mass, told in (("0.01", False), ("0.01", False), ("0.05", True)):
        assert export.main(["--robot.mass", mass, "--out", str(tmp_path)]) == 0
        said = capsys.readouterr()
        assert said.out.strip() == str(tmp_path / "felt.xml")
        assert ("is another than before" in said.err) == told
