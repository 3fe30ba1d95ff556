"""Causes that make a distance unsure are named where a walk of their own shows them."""

import re
from dataclasses import replace

import pytest
from fast_gaits import PART, near, read, row_of, scene_of

from analytic import GAITS, SURFACES, Gait, Robot, Surface
from mjsim.results.measures import measure
from mjsim.results.record import record
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene, Valves, resolved
from mjsim.simulation import second_walks
from mjsim.simulation.second_walks import FAST, SLOWER, doubts, slower, swiftness
from mjsim.simulation.simulation import simulate

LIGHT = Robot(length=0.11, mass=0.014, width=0.022, thickness=3e-3, modulus=0.25e6,
              peak_pressure=6e3)  # fmt: skip
SIDES = Surface("sides", tip_force=0.0, shear_strength=30.0)
LIGHT_GOES = 0.0049  # over L, by the elastica and by MuJoCo at 24 links and more
THROWN = Scene(
    Robot(weight_per_length=1.362, peak_pressure=59.15e3),
    Gait("thrown", ((0.0, 0.0, 0.0), (0.2, 0.47, 0.0), (0.7, 0.57, 0.82), (0.26, 0.0, 0.0),
                    (0.93, 0.53, 0.0), (0.02, 0.95, 0.42), (0.0, 0.0, 0.0)), 0.06918),
    Surface("any", tip_force=0.034, shear_strength=19.6),
)  # fmt: skip
STRONG = Scene(  # whose joints are damped by more than they should be at 5 ms
    Robot(weight_per_length=1.08758, peak_pressure=57953.0),
    Gait("strong", ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 1.0), (1.0, 1.0, 1.0),
                    (1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)), 0.53306),
    Surface("any", tip_force=0.102, shear_strength=19.615),
)  # fmt: skip


def row(predicted):
    """A record whose reference goes so far, straight ahead and without an error."""
    return {
        "predicted_displacement_over_L": predicted, "predicted_aside_over_L": 0.0,
        "predicted_turn_deg": 0.0, "prediction_uncertainty_over_L": 0.0,
        "prediction_uncertainty_deg": 0.0,
    }  # fmt: skip


def shift(scene, **numerics):
    return measure(simulate(scene, Numerics(**numerics))).displacement


def paced(scene, times):
    return replace(scene, gait=replace(scene.gait, ramp_time=times * scene.gait.ramp_times[0]))


@pytest.mark.parametrize("ramp", [2.0, pytest.param(8.0, marks=pytest.mark.slow)])
def test_too_few_links_are_told_as_links(ramp):
    scene = Scene(LIGHT, replace(GAITS["wave"], ramp_time=ramp), SIDES)
    (note,) = doubts(simulate(scene, Numerics(links=7)), row(LIGHT_GOES))
    cause, number, *_ = re.split(r": | L at ", note)
    assert cause == "links"
    assert float(number) == pytest.approx(LIGHT_GOES, abs=2e-4)
    assert not doubts(simulate(scene), row(LIGHT_GOES))


def test_too_long_a_time_step_is_told_as_time_step():
    walk = simulate(Scene(LIGHT, GAITS["wave"], SIDES), Numerics(timestep=0.1))
    (note,) = doubts(walk, row(LIGHT_GOES))
    assert note.startswith(f"time step: +{LIGHT_GOES} L at 0.005 s")


def test_a_gait_that_throws_the_robot_is_so_at_the_usual_time_step_and_at_longer_ones():
    """In the air as a whole, though both its ends stay low: at finer steps by 0.1 L."""
    for numerics in (Numerics(), Numerics(timestep=0.005)):
        assert simulate(THROWN, numerics).status is Status.TOPPLED


def test_a_walk_that_finer_steps_throw_says_so():
    scene = Scene(
        Robot(weight_per_length=1.6987, peak_pressure=44079.0),
        Gait("pairs", ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 0.0, 1.0),
                       (1.0, 1.0, 0.0), (0.0, 0.0, 0.0)), 0.10585),
        Surface("side", tip_force=0.0, shear_strength=19.6),
    )  # fmt: skip
    walk = simulate(scene, Numerics(timestep=0.005))
    assert walk.status is Status.OK
    assert doubts(walk, row(None)) == ["toppled at 48 links and 0.0005 s"]
    assert simulate(scene).status is Status.TOPPLED


def test_a_slow_walk_near_its_reference_is_not_walked_again(monkeypatch):
    walk = simulate(Scene())
    monkeypatch.setattr(second_walks, "simulate", lambda *_: pytest.fail("walked again"))
    assert swiftness(walk.scene) < FAST < swiftness(paced(walk.scene, 0.5))
    assert not doubts(walk, row(0.0336))  # felt, [Majidi13] in the limit of weak friction
    assert not doubts(walk, row(None))


def test_a_fast_walk_is_that_of_finer_steps():
    """At 5 ms the integrator's own damping doubles that of the joints."""
    fine = shift(STRONG, timestep=0.001)
    assert shift(STRONG) == pytest.approx(fine, rel=0.025)
    assert abs(shift(STRONG, timestep=0.005) - fine) > 0.035 * fine


def test_a_slower_walk_has_slower_ramps_and_valves_and_no_more_steps_than_it_needs():
    valves = Valves(fill_time=0.05, vent_time=(0.1, 0.2, 0.3), flow_limit=4e5)
    scene = replace(STRONG, valves=valves)
    slow, numerics = slower(scene, resolved(scene))
    assert slow.gait.period == pytest.approx(SLOWER * scene.gait.period)
    assert slow.valves == Valves(fill_time=0.4, vent_time=(0.8, 1.6, 2.4), flow_limit=5e4)
    assert numerics.timestep == 0.005
    assert slower(scene, resolved(scene, Numerics(timestep=0.02)))[1].timestep == 0.02


@pytest.mark.slow
@pytest.mark.parametrize("seed", [4, 16, 23])
def test_inertia_is_named_where_slower_ramps_change_the_distance_and_with_what_they_make_it(seed):
    walk = simulate(scene_of(seed))
    (note,) = (note for note in doubts(walk, record(walk)) if note.startswith("inertia"))
    slow = shift(paced(walk.scene, SLOWER))
    assert abs(slow - measure(walk).displacement) > 0.001
    assert float(note.split()[1]) == pytest.approx(slow, rel=PART, abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("surface", "ramp"),
    [*((surface, 0.2) for surface in SURFACES), ("felt", 0.3), ("polyethylene", 0.3),
     ("polyethylene", 0.5)],
)  # fmt: skip
def test_what_slower_ramps_change_is_told_as_inertia(surface, ramp):
    scene = Scene(gait=replace(GAITS["wave"], ramp_time=ramp), ground=SURFACES[surface])
    walk = simulate(scene)
    moved, slow = measure(walk).displacement, shift(paced(scene, SLOWER))
    told = [note for note in doubts(walk, record(walk)) if note.startswith("inertia")]
    assert len(told) == (abs(slow - moved) > max(PART * abs(moved), 1e-3))
    assert all(float(note.split()[1]) == pytest.approx(slow, rel=PART, abs=1e-3) for note in told)


def test_no_fast_gait_of_the_benchmark_is_silently_off_and_few_say_more_than_they_need():
    walked = [row for row in read() if row.status == "ok"]
    converged = [row for row in walked if row.converged]
    assert len(converged) > 20
    assert not [row for row in walked if not row.words and not row.right]
    assert sum(bool(row.words) for row in converged) <= 0.1 * len(converged)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 4, 11])
def test_rows_of_the_benchmark_are_what_it_finds(seed):
    (kept,) = (row for row in read() if row.seed == seed)
    again = row_of(seed)
    assert again[:5] == kept[:5]
    assert kept.status != "ok" or near(again.distance, kept.distance, 0.2)
    assert bool(again.words) == bool(kept.words)


@pytest.mark.parametrize(("slow", "told"), [(3.0, True), (-1.0, True), (1.2, False)])
def test_a_gait_that_hurls_its_robot_is_asked_whether_it_agrees_by_chance(monkeypatch, slow, told):
    """The finer walk is the same, the slow one goes otherwise; slower gaits are not asked."""
    for ramp, asked in ((0.1, told), (1.0, False)):
        scene = Scene(gait=replace(GAITS["wave"], ramp_time=ramp))
        assert (swiftness(scene) > 1) == (ramp == 0.1)
        walk = simulate(scene, Numerics(links=6, timestep=0.001))
        goes = measure(walk).displacement
        moved = second_walks.Moved(slow * goes, 0.0, 0.0)
        monkeypatch.setattr(second_walks, "_simulated", lambda *_, walk=walk: walk)
        monkeypatch.setattr(second_walks, "_walked", lambda *_, moved=moved: moved)
        notes = doubts(walk, row(goes))
        assert len(notes) == asked
        assert all("inertia" in note and "by chance" in note for note in notes)
