"""Scenes that nobody chose: robots, gaits, grounds and pressures drawn anew each time."""

import secrets

import numpy as np
import pytest
from scenes import cases, report

from mjsim.scene import Numerics


@pytest.mark.slow
def test_random_scenes_at_4_s_a_ramp_are_the_elastica_s():
    """At 2 s a ramp inertia adds to it; see docs/accuracy.md.

    Distances near the neutral ratio are short and their relative errors large: there 0.002 L.
    """
    seed = secrets.randbits(32)
    print(f"seed {seed}")  # shown where it fails
    drawn = cases(seed, sensitive=False)
    error = report(drawn, 4.0, Numerics())
    distance = np.abs([case.reference for case in drawn])
    assert np.median(error / distance) < 0.02
    # 3 of 200 were beyond it: of 40 drawn anew 4 are a chance of 1 in 3,000
    assert np.sum(error > np.maximum(0.06 * distance, 0.002)) <= 4
