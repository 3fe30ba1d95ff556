"""Gradient steps of the search: right slopes, up to where nothing is better, and by the grid."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.scene.gait import GAITS, Gait
from analytic.scene.limbs import quadruped
from analytic.scene.surface import SURFACES
from mjsim.optimising.ascent import EVALUATIONS, _ascend, known_gaits
from mjsim.optimising.objective import Objective
from mjsim.optimising.search import search
from mjsim.optimising.space import GRID, Space
from mjsim.scene import Scene

ENDS = Scene(contacts="ends")
SPACE = Space(3, 10.0)


def _of(name, **fields):
    return Objective(ENDS, (SURFACES[name],), **fields)


def _scaled(gait, part):
    stages = tuple(tuple(part * value for value in stage) for stage in gait.stages)
    return replace(gait, stages=stages)


def test_the_gradient_is_that_of_the_objective():
    gait, objective = _scaled(GAITS["wave"], 0.8), _of("felt")
    slope, cost = objective.gradient(gait)
    assert (slope.shape, cost) == ((5, 3), 1)
    step = 0.01
    for place in ((1, 0), (2, 1), (3, 2)):
        stages = np.array(gait.stages)
        ends = []
        for way in (-1, 1):
            moved = stages.copy()
            moved[place] += way * step
            ends.append(objective(replace(gait, stages=tuple(map(tuple, moved.tolist())))))
        assert slope[place] == pytest.approx((ends[1] - ends[0]) / (2 * step), rel=0.05, abs=2e-3)


def test_backwards_the_gradient_has_the_other_sign():
    gait = _scaled(GAITS["wave"], 0.8)
    ahead, back = (_of("felt", backward=way).gradient(gait)[0] for way in (False, True))
    assert np.abs(ahead).max() > 0.01
    assert back == pytest.approx(-ahead)


def test_on_several_grounds_it_is_of_the_one_that_counts():
    gait = _scaled(GAITS["wave"], 0.8)
    both = Objective(ENDS, (SURFACES["felt"], SURFACES["gelatin"]))
    slope, cost = both.gradient(gait)
    assert cost == 2
    assert slope == pytest.approx(_of("gelatin").gradient(gait)[0])


def test_from_less_pressure_the_wave_comes_to_full_pressure_and_its_published_distance():
    objective, start = _of("felt"), _scaled(GAITS["wave"], 0.7)
    ascent = _ascend(objective, start, objective(start), EVALUATIONS)
    assert ascent.values[-1] >= objective(GAITS["wave"]) - 1e-6
    assert np.array(ascent.best.stages).max() == 1.0
    assert ascent.evaluations <= EVALUATIONS


def test_what_it_finds_is_on_the_grid_of_valves_and_better_than_where_it_began():
    objective, start = _of("polyethylene"), GAITS["pulse"]
    ascent = _ascend(objective, start, objective(start), 10)
    stages = np.array(ascent.best.stages) / GRID
    assert np.abs(stages - stages.round()).max() < 1e-6
    assert max(ascent.values) > 1.2 * ascent.values[0]
    assert objective(ascent.best) == pytest.approx(max(ascent.values), abs=1e-12)


def test_an_ascent_ends_where_there_is_no_gradient():
    objective = Objective(replace(ENDS, contacts="ends"), (SURFACES["felt"],))
    flat = Gait("flat", ((0, 0, 0), (0, 0, 0)), 5.0)
    ascent = _ascend(objective, flat, 0.0, EVALUATIONS)
    assert (ascent.best, ascent.values, ascent.evaluations) == (flat, [0.0], 1)


def test_only_distances_of_the_elastica_are_climbed():
    assert _of("felt").has_gradient
    assert Objective(Scene(), (SURFACES["felt"],)).has_gradient  # which has the ends in it
    assert not _of("felt", model="lifted").has_gradient
    assert not _of("felt", aim="air").has_gradient
    assert not Objective(replace(ENDS, contacts="all"), (SURFACES["felt"],)).has_gradient


def test_known_gaits_go_both_ways_and_take_the_period():
    gaits = known_gaits(_of("felt"), SPACE._replace(period=5.0))
    assert {gait.period for gait in gaits[2:]} == {5.0}
    for gait in gaits:
        assert any(other.stages == gait.stages[::-1] for other in gaits)


def test_a_search_begins_with_what_is_known_and_keeps_to_its_number():
    pytest.importorskip("cma")
    course = list(search(_of("gelatin"), SPACE, 8, 0))
    assert course[-1].evaluations == 8
    assert course[-1].value == pytest.approx(_of("gelatin")(GAITS["wave"].reversed()), abs=1e-9)


def test_a_search_for_a_robot_of_limbs_is_no_worse_than_its_own_gait_both_ways(monkeypatch):
    pytest.importorskip("cma")
    scene = Scene(quadruped())
    own = {scene.gait.stages: 0.3, scene.gait.reversed().stages: -0.3}
    monkeypatch.setattr(Objective, "__call__", lambda _, gait: own.get(gait.stages, 0.1))
    objective = Objective(scene, (SURFACES["felt"],), model="mujoco")
    assert not objective.has_gradient
    course = list(search(objective, Space(5, 10.0), 4, 0))
    assert course[0].evaluations == course[-1].evaluations == 4
    assert (course[-1].value, course[-1].best.stages) == (0.3, scene.gait.stages)
