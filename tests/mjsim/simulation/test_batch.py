"""Scenes stepped side by side walk as each does alone, and what cannot be is walked alone."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from mujoco.batch import MODEL_FIELDS

from analytic.scene.actuator import Actuator
from analytic.scene.gait import GAITS, Gait
from analytic.scene.ground import Patches
from analytic.scene.robot import Robot
from analytic.scene.surface import SURFACES, Surface
from mjsim.results.measures import measure
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene, Valves
from mjsim.simulation.batch import Refused
from mjsim.simulation.side_by_side.layout import FIELDS, bare_model, field, refusal
from mjsim.simulation.side_by_side.simulate import simulate_batch
from mjsim.simulation.side_by_side.strips import StripBatch
from mjsim.simulation.simulation import simulate

COARSE = Numerics(links=12, timestep=0.01)


def random_scene(rng: np.random.Generator) -> Scene:
    robot = Robot()
    robot = replace(
        robot,
        peak_pressure=robot.peak_pressure * rng.uniform(0.5, 1.2),
        length=robot.length * rng.uniform(0.8, 1.2),
        modulus=robot.modulus * rng.uniform(0.8, 1.3),
        weight_per_length=robot.weight_per_length * rng.uniform(0.7, 1.5),
    )
    gait = replace(GAITS["wave"], ramp_time=float(rng.uniform(0.5, 1.0)))
    ground = SURFACES[str(rng.choice(list(SURFACES)))]
    lag = float(rng.choice([0.0, 0.1]))
    return Scene(robot, gait, ground, valves=Valves(fill_time=lag, vent_time=lag))


FELT, GELATIN = SURFACES["felt"], SURFACES["gelatin"]
WET = replace(GELATIN, name="wet", viscosity=200.0)
HELD = replace(FELT, name="held", static_ratio=1.4, stribeck_speed=0.002)
DRY = tuple(Surface(str(mu), friction=mu, tip_friction=0.3) for mu in (0.2, 0.5))
KINDS = {
    "level": {},
    "uphill": {"slope": 0.02},
    "patches": {"ground": Patches("felt_gelatin", (0.05,), (FELT, GELATIN)), "contacts": "ends"},
    "wet": {"ground": WET, "contacts": "ends"},
    "static friction": {"ground": HELD, "contacts": "ends"},
    "all contacts": {"contacts": "all"},
    "all contacts, uphill": {"contacts": "all", "slope": 0.02},
    "all contacts, patches": {"ground": Patches("felt_gelatin", (0.05,), (FELT, GELATIN)),
                              "contacts": "all"},
    "all contacts, wet": {"ground": WET, "contacts": "all"},
    "all contacts, by load": {"friction": "coulomb", "ground": DRY[0], "contacts": "all"},
    "by load": {"friction": "coulomb", "ground": DRY[0], "contacts": "ends"},
    "by load, patches": {"friction": "coulomb", "ground": Patches("mixed", (0.05,), DRY),
                         "contacts": "ends"},
    "actuators": {"actuation": "actuators"},
    "actuators, by load": {"actuation": "actuators", "friction": "coulomb", "ground": DRY[1],
                           "contacts": "ends"},
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_side_by_side_every_scene_walks_as_it_does_alone(kind):
    rng = np.random.default_rng(7)
    scenes = [replace(random_scene(rng), **KINDS[kind]) for _ in range(3 if KINDS[kind] else 6)]
    assert not any(map(refusal, scenes))
    together = simulate_batch(scenes, COARSE)
    for scene, walk in zip(scenes, together, strict=True):
        alone = simulate(scene, COARSE)
        assert walk.status == alone.status
        assert walk.line == pytest.approx(alone.line, abs=1e-9 * scene.robot.length)
        assert walk.contact_left == pytest.approx(alone.contact_left, abs=1e-9)
        assert walk.contact_right == pytest.approx(alone.contact_right, abs=1e-9)
        assert np.array_equal(walk.pressure, alone.pressure)
        assert np.array_equal(walk.time, alone.time)
        for name in ("left_slip_fraction", "drift"):
            one, two = getattr(walk, name), getattr(alone, name)
            assert one == pytest.approx(two, abs=1e-9, nan_ok=True), name
        if alone.status is Status.OK:
            one, two = measure(walk), measure(alone)
            assert one.displacement == pytest.approx(two.displacement, abs=1e-9)
            assert one.unexplained == pytest.approx(two.unexplained, abs=1e-9, nan_ok=True)


def test_measured_actuators_remember_side_by_side_as_alone():
    curve = Actuator((0, 50e3), (0, 25.0), play=(8e3,), share=(0.5,))
    scenes = [Scene(Robot(actuator=curve), ground="gelatin"), Scene()]
    together = simulate_batch(scenes, COARSE)
    for scene, walk in zip(scenes, together, strict=True):
        assert walk.line == pytest.approx(simulate(scene, COARSE).line, abs=1e-9 * 0.13)


def test_models_of_one_layout_differ_in_the_fields_that_rows_have_and_in_no_other():
    robot, numerics = Robot(), COARSE.resolved("chain", "constant")
    plain = bare_model(Scene(), numerics)
    others = [
        Scene(replace(robot, length=0.1, width=0.02, modulus=1.3e6)),
        Scene(replace(robot, segments=(0.5, 0.2, 0.3))),
        Scene(gravity=5.0, slope=0.1),
    ]
    strips = [(plain, scene) for scene in others]
    driven = bare_model(Scene(actuation="actuators"), numerics)
    thirds = (scene for scene in others if scene.strip.segments == robot.segments)
    strips += [(driven, replace(scene, actuation="actuators")) for scene in thirds]
    for one, scene in strips:
        other = bare_model(scene, numerics)
        for name in sorted(MODEL_FIELDS - set(FIELDS)):
            if name.startswith("opt.") and not hasattr(mujoco.MjOption(), name[4:]):
                continue
            assert np.array_equal(field(one, name), field(other, name)), name


def test_what_cannot_be_stepped_side_by_side_is_walked_alone_and_a_bad_scene_spoils_no_other():
    rod, tiny = Scene(body="rod", ground=SURFACES["gelatin"]), Scene(gravity=1e12)
    hasty = Scene(gait=replace(GAITS["wave"], ramp_time=0.02))
    rod_walk, plain, hasty_walk, tiny_walk = simulate_batch([rod, Scene(), hasty, tiny], COARSE)
    assert rod_walk.scene.body == "rod"
    assert measure(plain).direction == "forward"
    assert isinstance(hasty_walk, Refused)
    assert "timestep must be at most" in hasty_walk.message
    assert isinstance(tiny_walk, Refused)
    assert "too small" in tiny_walk.message


def test_a_strip_that_falls_stops_there_and_the_others_walk_on():
    curled = Gait("curled", ((0, 0, 0), (0.9, 0.9, 0.9), (0, 0, 0)), 0.05)
    heavy = Scene(gait=replace(GAITS["wave"], ramp_time=1.0))
    light = Scene(replace(Robot(), weight_per_length=0.05), curled)
    fell, walked = simulate_batch([light, heavy], Numerics(links=12, timestep=0.005))
    alone = simulate(light, Numerics(links=12, timestep=0.005))
    assert fell.status == alone.status is not Status.OK
    assert len(fell.time) == len(alone.time)
    assert walked.status is Status.OK


def test_a_row_can_be_given_another_scene():
    numerics = COARSE.resolved("chain", "constant")
    strips = StripBatch([Scene(), Scene()], numerics)
    other = Scene(replace(Robot(), length=0.1), ground=SURFACES["gelatin"])
    strips.reset(np.array([1]), [other])
    valves = np.full((1, 50, 3), 0.5 * Robot().peak_pressure)
    again = strips.play(valves, np.array([1]))
    fresh = StripBatch([other], numerics)
    fresh.reset(np.array([0]))
    assert np.array_equal(again.coordinates, fresh.play(valves).coordinates)


def test_scenes_of_other_kinds_are_refused_in_one_line():
    numerics = COARSE.resolved("chain", "constant")
    with pytest.raises(ValueError, match="body must be chain and friction constant or coulomb"):
        StripBatch([Scene(body="rod")], numerics)
    with pytest.raises(ValueError, match="contact paths must be straight"):
        StripBatch([Scene()], replace(numerics, contact_path="curved"))
    with pytest.raises(ValueError, match="one layout"):
        StripBatch([Scene(), Scene(friction="coulomb", contacts="ends")], numerics)
    with pytest.raises(ValueError, match="one layout"):
        StripBatch([Scene(), Scene(settle_time=1.0)], numerics)
