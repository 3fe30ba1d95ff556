"""The dielectric inchworm: what is published of it, and hops, which are no falls where allowed."""

import pytest

from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate
from studies.inchworm import BASE, LIGHTER, scene


def test_the_strip_has_the_published_mass_whatever_its_inertia():
    """3.5 g, 110 mm, 50 mm: Actuators 2022, 11(8), 227."""
    for lighter in (1.0, LIGHTER):
        what = scene(BASE, 10.0, lighter)
        assert what.robot.weight == pytest.approx(3.5e-3 * 9.81)
        assert what.robot.weight / what.gravity == pytest.approx(3.5e-3 / lighter)
        assert (what.robot.length, what.robot.width) == (0.110, 0.050)
        assert what.gait.period == pytest.approx(0.1)


@pytest.mark.slow
def test_a_strip_that_hops_is_thrown_unless_it_may_hop_so_high():
    numerics = {"links": 12, "timestep": 5e-4, "damping_time": BASE.damping}
    low, high = (
        simulate(scene(BASE, 4.0, cycles=3), Numerics(**numerics, hop=hop)) for hop in (0.01, 0.1)
    )
    assert low.status is Status.TOPPLED
    assert high.status is Status.OK
    top = high.line[high.start :, :, 2].min(axis=1).max()
    assert 0.01 < top / 0.110 < 0.1


def test_bounds_that_act_in_the_air_allow_no_hops():
    with pytest.raises(ValueError, match="hop must be at most"):
        simulate(Scene(), Numerics(hop=0.02))
    with pytest.raises(ValueError, match="hop does nothing"):
        simulate(Scene("quadruped"), Numerics(hop=0.005))
