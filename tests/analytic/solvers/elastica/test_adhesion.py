"""Adhesive ground: when an end peels, in closed form, and what it leaves unchanged."""

from dataclasses import replace

import numpy as np
import pytest

from analytic import (
    GAITS,
    SURFACES,
    Flag,
    Friction,
    Patches,
    Robot,
    Surface,
    predict,
    solve_elastica,
)
from analytic.scene import pneunet

LIGHT = replace(Robot(), weight_per_length=0.05)
PART = np.linspace(0, 1, 201)
PATH = PART[:, None] * np.array([1.0, 0.0, 0.0]) * LIGHT.peak_pressure


def inflated_end(adhesion, reach, links=120):
    ground = Surface("sticky", adhesion=adhesion, adhesion_reach=reach)
    return ground, solve_elastica(LIGHT, PATH, links, ground=ground)


@pytest.mark.parametrize(
    ("adhesion", "reach"), [(0.05, 5e-5), (0.05, 1e-4), (0.2, 1e-4), (0.2, 3e-4)]
)
def test_an_end_peels_at_the_curvature_of_the_closed_form_whatever_the_reach(adhesion, reach):
    """Under a constant pull w' = gamma q / reach an end of natural curvature kappa arches over

    a^2 = 4 D kappa / w' to a height of 9/128 D kappa^2 / w'. Where that is the reach the pull
    gives way: D kappa^2 = 128/9 gamma q.
    """
    _, shapes = inflated_end(adhesion, reach)
    peeled = int(np.flatnonzero(shapes.amplitude > 2 * reach)[0])
    pressure = float(PATH[peeled, 0])
    kappa = float(pneunet.natural_curvature(LIGHT, pressure))
    rigidity = float(pneunet.rigidity(LIGHT, pressure))
    assert rigidity * kappa**2 == pytest.approx(128 / 9 * adhesion * LIGHT.width, rel=0.1)


def test_before_it_peels_it_arches_as_a_heavy_strip_does():
    ground, shapes = inflated_end(0.2, 3e-4, links=240)
    state = int(np.searchsorted(PART, 0.4))
    kappa = float(pneunet.natural_curvature(LIGHT, PATH[state, 0]))
    rigidity = float(pneunet.rigidity(LIGHT, PATH[state, 0]))
    pull = ground.press(LIGHT.width) + LIGHT.weight_per_length
    assert shapes.amplitude[state] == pytest.approx(9 / 128 * rigidity * kappa**2 / pull, rel=0.1)


def test_the_ground_pushes_as_much_as_weight_and_adhesion_pull():
    ground, shapes = inflated_end(0.2, 3e-4)
    pull = ground.press(LIGHT.width) * LIGHT.length
    assert shapes.force[0].sum() == pytest.approx(LIGHT.weight + pull)
    solved = np.isfinite(shapes.residual)
    assert shapes.residual[solved].max() < 1e-6


def test_without_adhesion_its_reach_is_of_no_account():
    far = replace(SURFACES["gelatin"], adhesion_reach=1.0)
    path = GAITS["wave"].pressures(10) * Robot().peak_pressure
    one, two = (solve_elastica(Robot(), path, ground=g) for g in (SURFACES["gelatin"], far))
    assert (one.separation == two.separation).all()


@pytest.mark.slow
def test_the_stickier_the_farther_either_way():
    """A side that sticks stays long as the arch grows, and so holds for longer."""
    bent = Friction(tension=1.0)
    for name in ("felt", "gelatin"):
        grounds = (replace(SURFACES[name], adhesion=gamma) for gamma in (0.0, 0.02, 0.1))
        far = [abs(predict(Robot(), GAITS["wave"], g, friction=bent).locomotion.per_cycle)
               for g in grounds]  # fmt: skip
        assert far[0] < far[1] < far[2]


def test_it_may_hold_an_inflated_end_flat_at_full_pressure():
    _, shapes = inflated_end(4.0, 1e-3)
    assert shapes.status.max() == Flag.OK
    assert shapes.amplitude.max() < 1e-3


def test_what_adhesion_cannot_be_is_refused():
    sticky = replace(SURFACES["felt"], adhesion=0.1)
    with pytest.raises(ValueError, match="adhesion_reach"):
        replace(sticky, adhesion_reach=0.0)
    with pytest.raises(ValueError, match="uniform ground"):
        solve_elastica(LIGHT, PATH, ground=Patches("two", (0.1,), (sticky, sticky)))
    with pytest.raises(ValueError, match="'modes'"):
        predict(LIGHT, GAITS["wave"], sticky, "modes")
