"""Scenes that nobody chose: robots, gaits, grounds and pressures drawn anew each time."""

import secrets

import pytest
from many_seeds import walks


@pytest.mark.slow
def test_random_scenes_at_4_s_a_ramp_are_the_elastica_s():
    """At 2 s a ramp inertia adds to it; forty scenes are in benchmarks/many_seeds.csv.

    Distances near the neutral ratio are short and their relative errors large: there 0.002 L.
    """
    seed = secrets.randbits(32)
    print(f"seed {seed}")  # shown where it fails
    rows = walks(seed, 5)
    # 3 of 200 were beyond it: of 5 drawn anew 2 are a chance of 1 in 500
    assert sum(row.holds for row in rows) >= 4
