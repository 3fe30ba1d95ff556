"""Saved walks of robots of limbs are read back, shown, and described as they were."""

import tomllib
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from walks import turned, went

from analytic.scene.ground import Patches
from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES, Surface
from mjsim import load
from mjsim.commands import replay, report
from mjsim.files.scene_tables.tables import build
from mjsim.files.scene_tables.written import as_tables, as_toml
from mjsim.model.pads import pads_of
from mjsim.pictures import gl
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation, simulate

NUMERICS = Numerics(links=2, timestep=0.04)
GROUNDS = [
    SURFACES["gelatin"],
    Surface("mine", tip_force=0.02, shear_strength=12.0, viscosity=0.3),
    Patches("both", (0.06,), (SURFACES["felt"], SURFACES["gelatin"])),
]


def scene(ground=SURFACES["gelatin"], ramp_time=1.0):
    gait = replace(undulation("wave", left=0.7), ramp_time=ramp_time)
    return Scene(quadruped(), gait=gait, ground=ground)


@pytest.mark.parametrize("ground", GROUNDS, ids=lambda ground: ground.name)
def test_a_walk_is_read_as_it_was_saved(ground, tmp_path):
    walk = simulate(scene(ground), NUMERICS)
    walk.save(tmp_path / "walk.nc")
    again = load(tmp_path / "walk.nc")
    assert (again.scene, again.numerics, again.status) == (walk.scene, walk.numerics, walk.status)
    for name in ("time", "pressure", "coordinates", "contacts"):
        assert np.array_equal(getattr(again, name), getattr(walk, name))
    assert np.array_equal(went(again), went(walk))


@pytest.mark.parametrize("ground", GROUNDS[:2], ids=lambda ground: ground.name)
def test_a_scene_is_built_from_the_tables_that_it_is_written_as(ground):
    ahead = tuple(replace(limb, angle=limb.angle + 0.3) for limb in quadruped().limbs)
    one = replace(scene(ground), robot=replace(quadruped(), limbs=ahead))
    again, numerics = build(tomllib.loads(as_toml(as_tables(one, NUMERICS))))
    assert numerics == NUMERICS
    assert (again.gait, again.ground) == (one.gait, one.ground)
    for limb, written in zip(one.robot.limbs, again.robot.limbs, strict=True):
        assert written.strip == limb.strip
        assert written.angle == pytest.approx(limb.angle, rel=1e-15)


@pytest.mark.usefixtures("coarse")
@pytest.mark.slow
def test_the_page_of_a_robot_of_limbs_has_its_turn_its_limbs_and_its_scene(tmp_path):
    walk = simulate(scene(), NUMERICS)
    walk.save(tmp_path / "walk.nc")
    out = tmp_path / "page.html"
    assert report.main([str(tmp_path / "walk.nc"), "--no-video", "--out", str(out)]) == 0
    text = out.read_text("utf-8")
    assert "walks backward" in text
    assert f"{np.degrees(turned(walk)):+.2f}" in text
    assert "[[robot.limbs]]" in text
    assert "rear-left: 0 kPa" in text


def test_a_middle_line_is_as_long_as_its_limb_in_every_state():
    walk = simulate(scene(), NUMERICS)
    lengths = np.linalg.norm(np.diff(walk.position, axis=2), axis=-1).sum(axis=-1)
    strips = [limb.strip.length for limb in walk.scene.robot.limbs]
    assert lengths == pytest.approx(np.broadcast_to(strips, lengths.shape), rel=1e-9)


@pytest.mark.slow
@pytest.mark.skipif(gl.find_backend() is None, reason="nothing here renders")
def test_a_saved_walk_is_drawn_again(tmp_path):
    simulate(scene(ramp_time=0.2), NUMERICS).save(tmp_path / "walk.nc")
    assert replay.main([str(tmp_path / "walk.nc")]) == 0
    assert (tmp_path / "walk.mp4").stat().st_size > 10_000


def test_a_file_of_the_version_before_is_read_as_the_walk_that_it_was():
    """It has angles limb by limb, the places of the trunk alone, and elements for links."""
    before = load(Path(__file__).parents[1] / "results" / "limbs_of_0.2.0.nc")
    simulation = Simulation(before.scene, before.numerics)
    model, data, robot = simulation.model, simulation.data, before.scene.robot
    pads, radius = pads_of(model, before.scene), simulation.numerics.pad_radius
    for state in (0, len(before.time) // 2, -1):
        data.qpos[:] = before.coordinates[state]
        mujoco.mj_kinematics(model, data)
        places = data.geom_xpos[pads].mean(axis=2) - [0.0, 0.0, radius]
        assert before.position[state] == pytest.approx(places, abs=1e-6 * robot.length)
    # its tips had no width, which changes how far it goes ahead by little
    walk = simulate(before.scene, before.numerics)
    assert went(before)[0] == pytest.approx(went(walk)[0], abs=0.002 * robot.length)
