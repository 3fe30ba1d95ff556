"""States of limbs found on a guess of their contacts, against the states of least energy."""

import numpy as np
import pytest

from analytic.scene.limbs import quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES, Surface
from analytic.solvers.limbs import statics
from analytic.solvers.limbs.walk import walk

QUADRUPED = quadruped()


@pytest.mark.parametrize(
    ("name", "left", "twists"),
    [("felt", 1.0, 2), pytest.param("gelatin", 0.7, 0, marks=pytest.mark.slow)],
)
def test_states_on_their_contacts_are_those_of_least_energy_and_dissipation(
    name, left, twists, monkeypatch
):
    gait, ground = undulation("wave", left), SURFACES[name]
    path = walk(QUADRUPED, gait, ground, 6, 4, twists=twists)
    monkeypatch.setattr(statics, "on_contacts", lambda *_: None)
    least = walk(QUADRUPED, gait, ground, 6, 4, twists=twists)
    assert path.converged
    assert least.converged
    assert path.displacement == pytest.approx(least.displacement, abs=1e-4 * QUADRUPED.length)
    assert path.turn == pytest.approx(least.turn, abs=np.radians(0.05))


def test_on_the_way_every_node_pushes_up_and_none_is_below_the_ground():
    path = walk(QUADRUPED, undulation("wave", 0.8), SURFACES["gelatin"], 6, 4)
    weight = QUADRUPED.weight
    for rest in path.rests:
        assert rest.force.min() >= 0
        assert rest.force.sum() == pytest.approx(weight, rel=1e-5)
        assert rest.nodes[:, 2].min() > -1e-7 * QUADRUPED.length
        assert np.abs(rest.force * rest.nodes[:, 2]).max() < 1e-6 * weight * QUADRUPED.length


@pytest.mark.parametrize(
    "ground", [SURFACES["felt"], Surface("film", 0.0, 0.0, viscosity=100.0)], ids=lambda s: s.name
)
def test_jumps_of_what_resists_are_located_whatever_the_states(ground):
    few, many = (walk(QUADRUPED, undulation("wave"), ground, states, 4) for states in (7, 28))
    assert len(many.rests) - len(few.rests) > 60  # states, whatever the chance of what is located
    assert few.displacement[0] == pytest.approx(many.displacement[0], abs=(1e-4 * QUADRUPED.length))


def test_without_bending_they_are_located_too():
    few, many = (
        walk(QUADRUPED, undulation("wave", 0.7), SURFACES["felt"], states, 4, bent=False)
        for states in (7, 28)
    )
    assert few.displacement == pytest.approx(many.displacement, abs=1e-4 * QUADRUPED.length)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"path": np.full((3, 5), np.nan)}, "values that are none"),
        ({"path": np.zeros((3, 4))}, "rows of 5 numbers"),
        ({"path": np.zeros((3, 5)), "times": np.array([0.0, 2.0, 1.0])}, "not decrease"),
        ({"law": "x"}, "friction"),
        ({"states": 0}, "states"),
        ({"cycles": 0}, "cycles"),
    ],
)
def test_paths_and_options_that_mean_nothing_are_refused(options, words):
    with pytest.raises(ValueError, match=words):
        walk(QUADRUPED, undulation("wave"), SURFACES["felt"], **options)
