"""Robots below a ceiling: forces of a beam between two plates, balance, files and refusals."""

import json
import math

import mujoco
import numpy as np
import pytest
from walks import refusal

from analytic import Gait, Robot, Surface
from analytic.scene import pneunet
from mjsim.commands import run
from mjsim.commands.compare import compare
from mjsim.files.scene_tables.tables import build
from mjsim.files.scene_tables.written import as_tables
from mjsim.fitting.walks import quasi_static
from mjsim.model.standalone.strips import standalone_spec
from mjsim.results.measures import measure
from mjsim.results.prediction import prediction, reference
from mjsim.results.trajectory import load
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import Simulation, simulate

SMOOTH = Surface("smooth", friction=1e-6)
ARCH = Robot(segments=(1.0,), weight_per_length=1e-4, thickness=2e-3, peak_pressure=350.0)
RISE = Gait("rise", ((0.0,), (1.0,)), 2.0, repeats=False)


def arch_below(ceiling, **more):
    """An arch of one segment that is held at its peak pressure."""
    scene = Scene(ARCH, RISE, SMOOTH, friction="coulomb", gravity=0.01, ceiling=ceiling, **more)
    simulation = Simulation(scene, Numerics(links=24, timestep=0.002))
    parts = np.minimum(np.linspace(0.0, 1.5, 450), 1.0)
    simulation.play(ARCH.peak_pressure * parts[:, None])
    return simulation


def pressed(ceiling):
    """Force of a ceiling on that arch [N]."""
    return arch_below(ceiling).trajectory().ceiling_force[-50:].mean()


def test_a_ceiling_presses_an_arch_as_a_beam_between_two_plates():
    # natural curvature k, rigidity D: in the middle alone by P = 48 D / L^3 (k L^2 / 8 - h) less
    # 5/8 of the weight, while that leaves the middle curved, down to a third of its height; below,
    # flat between two spans of l = sqrt(6 h / k), whose ends carry D k / l each
    length, flat = ARCH.length, ARCH.flat_height
    rigidity = float(pneunet.rigidity(ARCH, ARCH.peak_pressure))
    curvature = float(pneunet.natural_curvature(ARCH, ARCH.peak_pressure))
    free = curvature * length**2 / 8
    assert 0.02 < free / length < 0.06  # shallow
    high, low = 0.7 * free, 0.25 * free
    point = 48 * rigidity / length**3 * (free - high) - 5 / 8 * ARCH.weight
    assert pressed(flat + high) == pytest.approx(point, rel=0.02)
    span = math.sqrt(6 * low / curvature)
    assert pressed(flat + low) == pytest.approx(2 * rigidity * curvature / span, rel=0.02)


@pytest.mark.parametrize("robot", ["strip", "quadruped"])
def test_a_ceiling_out_of_reach_changes_no_digit(robot):
    numerics = Numerics(links=12 if robot == "strip" else 4, timestep=0.02)
    free = simulate(Scene(robot), numerics)
    below = simulate(Scene(robot, ceiling=0.5), numerics)
    np.testing.assert_array_equal(below.coordinates, free.coordinates)
    assert not below.ceiling_force.any()
    assert not len(free.ceiling_force)


@pytest.mark.parametrize("part", [0.8, 1.2])
def test_a_ceiling_with_friction_holds_by_its_coefficient_times_what_it_presses(part):
    simulation = arch_below(ARCH.flat_height + 1.5e-3, ceiling_friction=0.5)
    press = simulation.trajectory().ceiling_force[-50:].mean()
    mass = ARCH.weight / simulation.scene.gravity
    simulation.model.opt.gravity[0] = part * 0.5 * press / mass  # pulls the arch along the ice
    simulation.play(np.full((100, 1), ARCH.peak_pressure))
    slid = np.diff(simulation.trajectory().line[[-101, -1], :, 0], axis=0).mean()
    excess = max(part - 1, 0.0) * 0.5 * press / mass
    assert slid == pytest.approx(excess * 0.2**2 / 2, rel=0.1, abs=2e-4)


def test_the_ground_carries_the_weight_and_what_the_ceiling_presses_down():
    scene = Scene(gait=Gait("rise", ((0, 0, 0), (1, 1, 0)), 2.0, repeats=False), ceiling="20 mm")
    walk = simulate(scene, forces=True)
    final = slice(-20, None)
    pushed = walk.ceiling_force[final].mean()
    assert pushed > 0.3 * scene.robot.weight
    assert walk.forces.normal[final].sum(axis=1).mean() == pytest.approx(
        scene.robot.weight + pushed, rel=5e-3
    )


def highest(walk):
    """Height of the highest place of the upper sides in each state, (T,) [m]."""
    steps = np.diff(walk.position, axis=2)
    level = np.linalg.norm(steps[..., :2], axis=-1) / np.linalg.norm(steps, axis=-1)
    height = walk.position[..., 2]
    return (np.maximum(height[..., 1:], height[..., :-1]) + Robot().flat_height * level).max((1, 2))


def test_the_quadruped_stays_below_its_ceiling_and_pays_for_it():
    free, below = (Scene("quadruped", ceiling=height) for height in (None, "19 mm"))
    walk, unhindered = simulate(below), simulate(free)
    assert highest(unhindered).max() > 0.024
    assert highest(walk).max() < 0.0195
    assert walk.ceiling_force.max() > 0.1 * free.robot.weight
    assert 0.2 < measure(walk).displacement / measure(unhindered).displacement < 0.8
    simulation = Simulation(below)
    simulation.play(np.full((400, 5), below.robot.peak_pressure))
    contact, force = simulation.data.contact, simulation.data.efc_force
    above = contact.geom1 == simulation.model.geom("ceiling").id
    carried, pressing = force[contact.efc_address[~above]], force[contact.efc_address[above]]
    assert pressing.sum() > 0
    assert carried.sum() == pytest.approx(below.robot.weight + pressing.sum(), rel=0.01)


def test_the_reference_says_that_it_knows_no_ceiling_only_where_one_is_touched():
    free, high, low = (Scene(ceiling=height) for height in (None, "50 mm", "30 mm"))
    far = reference(free)
    assert reference(high).displacement[0] == far.displacement[0]
    touching = reference(low)
    assert math.isnan(touching.displacement[0])
    assert touching.flags[-1] == "touches_ceiling"
    assert prediction(high, "lifted").locomotion.per_cycle
    with pytest.raises(ValueError, match="ceiling must be above all that the robot does"):
        prediction(low, "lifted")
    assert quasi_static(low, Numerics(), (0.5,)) is None


def test_models_without_a_ceiling_are_refused_in_their_row_of_a_comparison():
    rows = compare(Scene(ceiling="30 mm"), ("lifted", "rod", "chain"), Numerics(12, 0.02))
    status = {row["model"]: row["status"] for row in rows}
    assert status["lifted"].startswith("refused: ceiling must be above all that the robot does")
    assert status["rod"].startswith("refused: body must be chain below a ceiling")
    assert status["chain"] == "ok"


@pytest.mark.parametrize("robot", ["strip", "quadruped"])
def test_a_file_that_walks_by_itself_has_the_ceiling(robot):
    scene = Scene(robot, ceiling="19 mm")
    model = mujoco.MjModel.from_xml_string(standalone_spec(scene).to_xml())
    data = mujoco.MjData(model)
    data.ctrl[:] = scene.robot.peak_pressure
    for _ in range(400):
        mujoco.mj_step(model, data)
    ceiling = model.geom("ceiling").id
    assert (data.contact.geom1 == ceiling).any()
    pads = [i for i in range(model.ngeom) if "_pad_" in model.geom(i).name]
    assert data.geom_xpos[pads, 2].max() < 0.019 - Robot().flat_height + 2e-3


def test_a_ceiling_is_in_the_record_the_file_and_the_tables(tmp_path, capsys):
    options = [
        "--ceiling",
        "1.9 cm",
        "--ceiling-friction",
        "0.2",
        "--links",
        "12",
        "--timestep",
        "0.02",
        "--no-video",
    ]
    assert run.main([*options, "--timestep", "0.02", "--json", "--out", str(tmp_path)]) == 0
    row = json.loads(capsys.readouterr().out)
    assert row["ceiling_m"] == pytest.approx(0.019)
    assert row["predicted_displacement_over_L"] is None
    assert row["prediction_flags"] == ["TOUCHES_CEILING"]
    assert 0 < row["ceiling_time_fraction"] < 1
    assert row["ceiling_force_N"] > 0
    assert "at the ceiling for" in row["prediction_notes"][0]
    walk = load(row["trajectory"])
    assert walk.scene.ceiling == row["ceiling_m"]
    assert walk.ceiling_force.max() == row["ceiling_force_N"]
    assert walk.dataset().ceiling_force.units == "N"
    scene, _ = build(as_tables(walk.scene, walk.numerics))
    assert scene == walk.scene


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ("--ceiling 7mm", "--ceiling must be above 0.007928 m, the height of the flat robot, got"),
        ("--ceiling 0", "--ceiling must be a positive finite number [m]"),
        ("--ceiling nan", "--ceiling must be a positive finite number [m]"),
        (
            "--ceiling 19",
            "--ceiling must be near a robot 0.13 m long, got 19 m; did you mean 19 mm",
        ),
        (
            "--ceiling-friction 0.3",
            "--ceiling-friction is for a ceiling, whose height must be",
        ),
        ("--ceiling 19mm --ceiling-friction -1", "--ceiling-friction must be a finite number"),
        ("--ceiling 19psi", "--ceiling must be a number of m, or one with its unit"),
        ("--ceiling 19mm --body rod", "--body must be chain below a ceiling, got 'rod'"),
    ],
)
def test_ceilings_that_cannot_be_are_refused(options, words, capsys):
    assert words in refusal(options.split(), capsys)
