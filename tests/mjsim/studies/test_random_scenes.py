"""Scenes that nobody chose: robots, gaits, grounds and pressures drawn at random."""

import pytest
from scenes import cases, report

from mjsim.scene import Numerics


@pytest.mark.slow
def test_random_scenes_at_4_s_a_ramp_are_the_elastica_s():
    """At 2 s a ramp inertia adds to it; see docs/accuracy.md."""
    middle, high = report(cases(), 4.0, Numerics())
    assert middle < 0.02
    assert high < 0.06
