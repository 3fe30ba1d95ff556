"""Pressure as a control: actuators are the springs they stand for, and chambers follow valves."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from walks import HEAVIER

from analytic import SURFACES, Elastica, Friction, predict
from analytic.scene import pneunet
from analytic.scene.chain import joint_springs, segment_overlap
from analytic.scene.surface import from_ratios
from mjsim.model.builder import compile_model
from mjsim.model.chambers import ChamberPressures
from mjsim.model.pneumatics import controls
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene, Valves
from mjsim.simulation.batch import rollout, simulate_all
from mjsim.simulation.simulation import simulate

BASE = Scene(HEAVIER, ground=SURFACES["gelatin"])
pressures = st.lists(st.floats(0, 6e4), min_size=3, max_size=3).map(np.array)


def displacement(scene, numerics=None):
    return measure(simulate(scene, numerics)).displacement


@pytest.mark.parametrize("chamber", ["linearized", "constant-pressure"])
@pytest.mark.parametrize("lag", [0.0, 0.1])
@pytest.mark.parametrize("friction", ["constant", "coulomb"])
def test_actuators_walk_as_springs_do_to_a_millionth(chamber, lag, friction):
    scene = replace(BASE, chamber=chamber, valves=Valves(lag), friction=friction)
    springs, actuators = (
        displacement(replace(scene, actuation=d)) for d in ("rest-angles", "actuators")
    )
    assert actuators == pytest.approx(springs, abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(pressures, st.floats(-0.3, 0.3), st.sampled_from(["linearized", "constant-pressure"]))
def test_the_moment_of_gain_and_input_is_that_of_the_law(pressure, turn, chamber):
    """Equation (9), or constant pressure, at any angle."""
    scene = replace(BASE, chamber=chamber, actuation="actuators")
    numerics = Numerics(links=6)
    inputs = controls(scene, numerics, pressure[None], pressure, pressure[None])[0]
    robot, element = HEAVIER, HEAVIER.length / 6
    bend = pneunet.curvature_per_pressure(robot) * pneunet.base_rigidity(robot)
    stiff = pneunet.rigidity_per_pressure(robot)
    layer = -pneunet.base_rigidity(robot) / element * turn
    overlap = segment_overlap(robot.borders, 6)
    if chamber == "constant-pressure":
        torque = layer - bend * (overlap @ inputs)
    else:
        square = overlap @ inputs[6:]
        torque = layer + (-bend - stiff / element * turn) * inputs[:6]
        torque = torque - pneunet.curvature_per_pressure(robot) * stiff * square
    stiffness, rest = joint_springs(robot, 6, pressure[None, :], chamber)
    assert torque == pytest.approx(-stiffness[0] * (turn - rest[0]), rel=1e-9, abs=1e-12)


def test_chambers_follow_a_step_of_the_valve_exponentially():
    scene, numerics = replace(BASE, valves=Valves(0.3)), Numerics(timestep=0.01)
    step = np.ones((200, 3)) * 5e4
    pressures = ChamberPressures(scene.valves, 3, numerics.timestep).follow(step)
    time = 0.01 * np.arange(1, 201)
    assert pressures[:, 0] == pytest.approx(5e4 * (1 - np.exp(-time / 0.3)), rel=1e-9)


def test_mujoco_s_filters_hold_the_pressure_and_its_square():
    scene = replace(BASE, valves=Valves(0.2), actuation="actuators", friction="coulomb")
    numerics = Numerics(links=6).resolved("chain", "coulomb")
    model = compile_model(scene, numerics)
    data = mujoco.MjData(model)
    rest, time = np.zeros(3), np.arange(1, 401) * numerics.timestep
    command = scene.robot.peak_pressure * scene.gait.fractions(time)
    pressure = ChamberPressures(scene.valves, 3, numerics.timestep).follow(command)
    for step, control in enumerate(controls(scene, numerics, command, rest, pressure)):
        data.ctrl[:] = control
        mujoco.mj_step(model, data)
        assert data.act[:6:2] == pytest.approx(pressure[step], abs=1e-6)
        assert data.act[6:] == pytest.approx(pressure[step] ** 2, rel=1e-9, abs=1e-3)


@pytest.mark.parametrize("chamber", ["linearized", "sealed", "constant-pressure"])
def test_each_gas_meets_the_reference_that_bends_by_the_same_law(chamber):
    scene = replace(BASE, chamber=chamber)
    exact = predict(HEAVIER, scene.gait, scene.ground, Elastica(36, chamber), 25,
                    friction=Friction(tension=1.0))  # fmt: skip
    exact = exact.locomotion.per_cycle
    assert displacement(scene) == pytest.approx(exact / HEAVIER.length, rel=0.02)


def test_open_valves_bend_less_against_the_weight_than_closed_ones():
    """A closed chamber stiffens: constant pressure gives way, and the strip stands lower."""
    heights = {chamber: measure(simulate(replace(BASE, chamber=chamber))).amplitude
               for chamber in ("constant-pressure", "linearized", "sealed")}  # fmt: skip
    assert heights["constant-pressure"] < 0.99 * heights["linearized"]
    assert heights["sealed"] == pytest.approx(heights["linearized"], rel=0.005)


def test_chambers_that_lag_are_compared_along_their_own_path():
    from mjsim.results.record import record

    row = record(simulate(replace(BASE, ground=SURFACES["felt"], valves=Valves(0.2))))
    assert row["error_over_L"] == pytest.approx(0, abs=0.001)


def rollable(area):
    ground = from_ratios("mixed", 1.0, area)
    return Scene(HEAVIER, ground=ground, friction="coulomb", actuation="actuators")


def test_a_rollout_walks_as_the_loop_does_but_for_the_pads_of_flat_ends():
    scenes = [rollable(area) for area in (0.0, 0.3)]
    for scene, walk in zip(scenes, rollout(scenes), strict=True):
        looped = simulate(scene)
        assert walk.pressure == pytest.approx(looped.pressure)
        assert measure(walk).displacement == pytest.approx(displacement(scene), rel=0.1)
        assert measure(walk).amplitude == pytest.approx(measure(looped).amplitude, abs=0.002)


def test_a_rollout_is_the_same_on_any_number_of_threads():
    scenes = [rollable(area) for area in (0.0, 0.1, 0.2)]
    for one, two in zip(rollout(scenes, threads=1), rollout(scenes, threads=2), strict=True):
        assert np.array_equal(one.coordinates, two.coordinates)


def test_scenes_that_need_python_in_the_loop_are_no_rollout():
    with pytest.raises(
        ValueError, match="actuators and friction coulomb, got rest-angles and constant"
    ):
        rollout([BASE])
    with pytest.raises(ValueError, match="one duration"):
        rollout([rollable(0.0), replace(rollable(0.0), cycles=2)])


@pytest.mark.slow
def test_processes_return_what_one_process_does():
    scenes = [replace(BASE, ground=surface) for surface in SURFACES.values()]
    for scene, walk in zip(scenes, simulate_all(scenes, Numerics(links=12)), strict=True):
        assert walk.scene == scene
        again = simulate(scene, Numerics(links=12))
        assert np.array_equal(walk.coordinates, again.coordinates)


@pytest.mark.parametrize("body", ["cable", "rod"])
def test_actuators_and_sealed_gas_are_the_planar_body_s(body):
    for special in ({"actuation": "actuators"}, {"chamber": "sealed"}):
        with pytest.raises(ValueError, match=f"body {body}"):
            simulate(Scene(body=body, **special))
    with pytest.raises(ValueError, match="chamber sealed needs actuation rest-angles"):
        simulate(Scene(chamber="sealed", actuation="actuators"))


def test_chambers_must_be_whole_elements():
    for special in ({"actuation": "actuators"}, {"chamber": "sealed"}):
        with pytest.raises(ValueError, match="got 10"):
            simulate(Scene(**special), Numerics(links=10))
