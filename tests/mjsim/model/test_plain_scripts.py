"""Scripts of models/ that need mujoco and numpy alone, beside mjsim."""

import ast
import importlib.util
import sys
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from analytic import GAITS, SURFACES, quadruped
from mjsim.files.assets import MODELS
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

PEAK = 48263.3
ALSO_SLOW = ["gelatin", *(pytest.param(name, marks=pytest.mark.slow) for name in
                          ("felt", "polyethylene"))]  # fmt: skip


def script(name):
    spec = importlib.util.spec_from_file_location(name, MODELS / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def by_mjsim(scene):
    walked = simulate(replace(scene, chamber="constant-pressure"), Numerics(twists=0))
    return measure(walked).displacement


@pytest.mark.parametrize("name", ALSO_SLOW)
def test_the_strip_goes_as_far_as_in_mjsim(name):
    scene = Scene(ground=SURFACES[name], actuation="actuators")
    assert script("walk_strip").walk(name) == pytest.approx(by_mjsim(scene), abs=1e-4)


@pytest.mark.parametrize("name", ALSO_SLOW)
def test_the_quadruped_goes_as_far_as_in_mjsim(name):
    robot = quadruped()
    scene = Scene(robot, GAITS["wave"], ground=SURFACES[name])  # 1 s a ramp wants steps of 2.5 ms
    assert script("walk_quadruped").walk(name) == pytest.approx(by_mjsim(scene), abs=1e-3)


@pytest.mark.parametrize(("name", "most"), [("walk_strip", 100), ("walk_quadruped", 280)])
def test_they_are_short_and_need_mujoco_and_numpy_alone(name, most):
    text = (MODELS / f"{name}.py").read_text()
    used = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            used |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            used.add(node.module)
    assert {part.partition(".")[0] for part in used} - set(sys.stdlib_module_names) == {
        "mujoco", "numpy"
    }  # fmt: skip
    assert sum(bool(line.strip()) for line in text.splitlines()) <= most


FLOOR = "<mujoco><worldbody><geom name='floor' type='plane' size='2 2 1'/></worldbody></mujoco>"
HILLS = (
    "<mujoco><asset><hfield name='hills' nrow='20' ncol='20' size='0.4 0.2 0.002 0.05' elevation='"
    + " ".join(f"{0.5 + 0.5 * np.sin(0.9 * i):.3f}" for _ in range(20) for i in range(20))
    + "'/></asset><worldbody><geom type='hfield' hfield='hills'/></worldbody></mujoco>"
)


def walk(model, prefix=""):
    """Displacement of the robot along the axis of its frame in one wave, and its lowest pad."""
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=100)
    chambers = [model.actuator(f"{prefix}robot_segment_{i}").id for i in (1, 2, 3)]
    start, lowest = float(data.joint(f"{prefix}robot_x").qpos[0]), 0.0
    dt = model.opt.timestep
    times = np.arange(1, round(10 / dt) + 1) * dt
    for row in PEAK * GAITS["wave"].fractions(times):
        data.ctrl[chambers] = row
        mujoco.mj_step(model, data)
        lowest = min(lowest, float(data.geom_xpos[:, 2].min()))
    return (float(data.joint(f"{prefix}robot_x").qpos[0]) - start) / 0.13, lowest


def test_a_robot_in_another_scene_walks_as_its_file_and_brings_no_floor_along():
    scene = mujoco.MjSpec.from_string(FLOOR)
    place = {"pos": (0.3, 0.1, 0.0), "quat": (np.cos(0.4), 0.0, 0.0, np.sin(0.4))}
    script("attach").attach(scene, MODELS / "gelatin.xml", prefix="a_", **place)
    model = scene.compile()
    assert [model.geom(i).name for i in range(model.ngeom) if "robot" not in model.geom(i).name] \
        == ["floor"]  # fmt: skip
    assert (model.nlight, model.ncam, model.ntex) == (0, 0, 0)
    alone = mujoco.MjModel.from_xml_path(str(MODELS / "gelatin.xml"))
    assert walk(model, "a_")[0] == pytest.approx(walk(alone)[0], abs=0.002)


@pytest.mark.slow
def test_two_robots_in_one_scene_go_each_its_way():
    scene = mujoco.MjSpec.from_string(FLOOR)
    attach = script("attach").attach
    for number, name in enumerate(("felt", "gelatin")):
        attach(scene, MODELS / f"{name}.xml", (0.0, 0.1 * number, 0.0), prefix=f"{name}_")
    model = scene.compile()
    assert walk(model, "felt_")[0] == pytest.approx(0.031, abs=0.003)
    assert walk(model, "gelatin_")[0] == pytest.approx(-0.035, abs=0.003)


@pytest.mark.parametrize("file", ["gelatin", "gelatin_coulomb"])
def test_pads_stay_on_a_height_field(file):
    scene = mujoco.MjSpec.from_string(HILLS)
    script("attach").attach(scene, MODELS / f"{file}.xml", (0.0, 0.0, 0.002), prefix="a_")
    _, lowest = walk(scene.compile(), "a_")
    assert lowest > -1e-4


def test_an_arena_of_dm_control_takes_them():
    mjcf = pytest.importorskip("dm_control.mjcf", exc_type=ImportError)
    arena = mjcf.RootElement(model="arena")
    arena.visual.headlight.ambient = (0.1, 0.1, 0.1)
    arena.worldbody.add("geom", type="plane", size=(2, 2, 0.1))
    script("attach").attach_to_arena(arena, MODELS / "gelatin.xml")
    model = mjcf.Physics.from_mjcf_model(arena).model.ptr
    assert model.opt.timestep == 0.005
    assert walk(model, "undulator/")[0] == pytest.approx(-0.035, abs=0.003)
