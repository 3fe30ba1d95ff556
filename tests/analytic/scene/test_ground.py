"""Ground that changes along x, in theory."""

import numpy as np
import pytest

from analytic import GAITS, SURFACES, Patches, Robot, predict
from analytic.scene.ground import over

FELT, GELATIN = SURFACES["felt"], SURFACES["gelatin"]
WAVE, LENGTH = GAITS["wave"], Robot().length


def cycles(ground, count, **options):
    """Displacement of the left end after each cycle, over L."""
    walk = predict(Robot(), WAVE, ground, cycles=count, **options)
    rests = np.flatnonzero((walk.pressures == 0).all(axis=1))
    return walk.locomotion.left[rests] / LENGTH


def test_patches_of_one_surface_are_that_surface():
    patched = cycles(Patches("felt", (0.05, 0.1), (FELT, FELT, FELT)), 2)
    assert patched == pytest.approx(cycles(FELT, 2), abs=1e-4)


def test_far_from_the_border_it_walks_as_on_the_surface_it_is_on():
    ground = Patches("both", (1.0,), (FELT, GELATIN))
    assert cycles(ground, 2) == pytest.approx(cycles(FELT, 2), abs=1e-4)
    ground = Patches("both", (-1.0,), (FELT, GELATIN))
    assert cycles(ground, 2) == pytest.approx(cycles(GELATIN, 2), abs=1e-4)


@pytest.mark.slow
def test_from_felt_onto_gelatin_it_stalls_at_the_seam():
    """Forward on felt until its right end stands on gelatin; then ever more slowly, by the part of
    its side that still lies on felt.
    """
    x = cycles(Patches("felt-gelatin", (0.15,), (FELT, GELATIN)), 9)
    assert (np.diff(x[:4]) > 0.03).all()
    assert np.diff(x[6:]).max() < 0.002
    assert (np.diff(x[5:], 2) < 1e-5).all()
    assert x[-1] < 0.15 / LENGTH < x[-1] + 1


def test_a_side_across_a_seam_rests_on_the_mean_of_both():
    ground = Patches("felt-gelatin", (0.15,), (FELT, GELATIN))
    mean = over(ground, 0.14, 0.18)
    assert mean.shear_strength == pytest.approx(0.25 * FELT.shear_strength)
    assert mean.tip_force == pytest.approx(0.75 * GELATIN.tip_force)
    assert over(ground, 0.10, 0.14) == FELT
    assert over(FELT, 0.14, 0.18) is FELT

    class Field:
        name = "field"

        def at(self, x):
            return FELT.scaled(x)

    assert over(Field(), 1.0, 3.0).shear_strength == pytest.approx(2 * FELT.shear_strength)


def test_the_mirrored_ground_takes_it_the_mirrored_way():
    """Seen from the other side: the reversed order of segments, the borders about the middle."""
    there = predict(Robot(), WAVE, Patches("a", (0.10,), (GELATIN, FELT)), states_per_ramp=200)
    stages = tuple(stage[::-1] for stage in WAVE.stages)
    mirrored = WAVE.__class__("mirrored", stages)
    ground = Patches("b", (LENGTH - 0.10,), (FELT, GELATIN))
    back = predict(Robot(), mirrored, ground, states_per_ramp=200)
    assert there.locomotion.left[-1] == pytest.approx(-back.locomotion.right[-1], abs=2e-3 * LENGTH)


@pytest.mark.parametrize(
    ("borders", "surfaces", "named"),
    [((), (FELT,), "at least one border"), ((0.1, 0.1), (FELT,) * 3, "ascend"),
     ((0.1,), (FELT,), "2 surfaces"), ((float("nan"),), (FELT, GELATIN), "finite")],
)  # fmt: skip
def test_patches_that_cannot_be_are_refused(borders, surfaces, named):
    with pytest.raises(ValueError, match=named):
        Patches("bad", borders, surfaces)
