import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from analytic import MATERIALS, Actuator, Robot, predict
from analytic.friction.contact_length import bending_peaks
from analytic.scene import pneunet
from analytic.scene.actuator import Memory
from analytic.scene.limbs import acting_pressures, as_bent, as_strip

PEAK = Robot().peak_pressure
ALPHA = pneunet.curvature_per_pressure(Robot())
STRAIGHT = Actuator((0.0, PEAK), (0.0, ALPHA * PEAK))
SOFT = Actuator(tuple(PEAK * np.linspace(0, 1, 9)), tuple(20 * np.linspace(0, 1, 9) ** 1.7))


def test_a_straight_curve_is_the_affine_law():
    robot, pressures = Robot(actuator=STRAIGHT), np.linspace(-PEAK, 1.1 * PEAK, 200)
    assert_allclose(
        pneunet.natural_curvature(robot, pressures), ALPHA * pressures, rtol=1e-14, atol=1e-15
    )
    assert_array_equal(pneunet.rigidity(robot, pressures), pneunet.rigidity(Robot(), pressures))
    assert pneunet.turn_number(robot) == pytest.approx(pneunet.turn_number(Robot()), rel=1e-14)
    assert_allclose(bending_peaks(robot), bending_peaks(Robot()), rtol=1e-12)


def test_curves_pass_their_points_rise_and_have_no_corners():
    for curvature in ((0, 1, 1, 5, 6, 30), (0, 9, 10, 10, 10, 11), (0, 0, 0, 1, 8, 9)):
        curve = Actuator((0, 1e3, 2e3, 5e3, 6e3, 9e3), curvature)
        assert_allclose(curve.curvature_at(curve.pressure), curvature, atol=1e-12)
        p = np.linspace(0, 12e3, 24_001)
        slope = np.diff(curve.curvature_at(p)) / np.diff(p)
        assert slope.min() >= -1e-12
        assert np.abs(np.diff(slope)).max() < 2e-2 * slope.max()  # h times the second derivative


def test_the_cubics_are_those_of_scipys_pchip():
    from scipy.interpolate import PchipInterpolator

    rng = np.random.default_rng(1)
    for count in (2, 3, 4, 9):
        p = np.concatenate([[0], np.cumsum(rng.uniform(0.1, 3, count - 1))])
        k = np.concatenate([[0], np.cumsum(rng.uniform(0, 2, count - 1) * (rng.random() > 0.1))])
        at = np.linspace(0, p[-1], 101)
        assert_allclose(
            Actuator(tuple(p), tuple(k)).curvature_at(at), PchipInterpolator(p, k)(at), atol=1e-12
        )


def test_a_play_makes_a_loop_of_a_closed_form():
    # k = s p up to P: s (p - w r) as p rises beyond r, s p as it falls below P - r
    top, width, share, slope = 50e3, 8e3, 0.3, 4e-4
    curve = Actuator((0.0, top), (0.0, slope * top), play=(width,), share=(share,))
    ramp = np.linspace(0, top, 5001)
    path = np.concatenate([ramp, ramp[::-1]])
    bend = curve.curvature_at(Memory([curve]).follow(path[:, None])[:, 0])
    area = -np.trapezoid(bend, path)
    assert area == pytest.approx(slope * share * width * (top - width), rel=1e-6)
    rising = bend[:5001][ramp > width]
    assert_allclose(rising, slope * (ramp[ramp > width] - share * width), rtol=1e-12)
    assert bend[-1] == 0.0


def symmetric_loop(path, widths, shares):
    """Prandtl-Ishlinskii with the usual plays, which stay within half a width of the pressure."""
    states, out = [width / 2 for width in widths], []
    for p in path:
        for i, width in enumerate(widths):
            states[i] = min(max(states[i], p - width / 2), p + width / 2)
        out.append(p - sum(w * (p - y) for w, y in zip(shares, states, strict=True)))
    return np.array(out)


def test_plays_are_those_of_prandtl_and_ishlinskii_less_what_stays_at_rest():
    rng = np.random.default_rng(0)
    corners = np.concatenate([[0], rng.uniform(0, 40e3, 12), [0], rng.uniform(0, 40e3, 5)])
    path = np.interp(np.linspace(0, len(corners) - 1, 900), np.arange(len(corners)), corners)
    widths, shares = (2e3, 9e3, 30e3), (0.1, 0.2, 0.15)
    curve = Actuator((0, 40e3), (0, 10.0), play=widths, share=shares)
    expected = symmetric_loop(path, widths, shares) - np.dot(widths, shares) / 2
    assert_allclose(Memory([curve]).follow(path[:, None])[:, 0], expected, atol=1e-8)


def test_memory_goes_on_where_a_path_was_cut_and_forgets_at_no_pressure():
    curve = Actuator((0, 40e3), (0, 10.0), play=(9e3,), share=(0.4,))
    path = 40e3 * np.sin(np.linspace(0, 9, 500))[:, None] ** 2
    whole, parts = Memory([curve]).follow(path), Memory([curve])
    assert_array_equal(np.concatenate([parts.follow(path[:123]), parts.follow(path[123:])]), whole)
    both = np.array([[0.0], [30e3], [-20e3], [-10e3]])  # to the other face within a step
    assert_allclose(Memory([curve]).follow(both)[:, 0], [0, 26.4e3, -16.4e3, -10e3])


def test_without_hysteresis_the_pressures_are_the_chambers():
    path = np.ones((4, 3))
    assert acting_pressures(Robot(), path) is path
    assert acting_pressures(Robot(actuator=SOFT), path) is path


def test_segments_may_have_curves_of_their_own():
    robot = Robot(actuator=(STRAIGHT, SOFT, STRAIGHT))
    p = np.linspace(0, PEAK, 12).reshape(4, 3)
    curvature = pneunet.natural_curvature(robot, p)
    assert_allclose(curvature[:, ::2], ALPHA * p[:, ::2])
    assert_allclose(curvature[:, 1], SOFT.curvature_at(p[:, 1]))
    with pytest.raises(ValueError, match="one per segment, got 2"):
        Robot(actuator=(SOFT, SOFT))


def test_a_measured_rigidity_replaces_the_affine_one_and_the_modulus():
    stiff = Actuator((0.0, PEAK), (0.0, 20.0), (4e-4, 6e-4))
    robot = Robot(actuator=stiff)
    assert pneunet.base_rigidity(robot) == pytest.approx(4e-4)
    assert_allclose(pneunet.rigidity(robot, [0, 0.5 * PEAK, -PEAK]), [4e-4, 5e-4, 6e-4])
    with pytest.raises(ValueError, match="modulus must be given, not both"):
        Robot(actuator=stiff, modulus=1e6)
    with pytest.raises(ValueError, match="rigidity_per_pressure must be given, not both"):
        Robot(actuator=stiff, rigidity_per_pressure=1e-10)


def test_a_late_actuator_lies_flat_until_it_bends():
    late = Actuator((0, 0.4 * PEAK, PEAK), (0, 0, 20.0))
    assert 0.004 * 100 * PEAK < bending_peaks(Robot(actuator=late))[0] * 0.01 < 0.5 * PEAK


def test_theory_walks_equally_far_with_a_straight_curve():
    from analytic import GAITS, SURFACES

    one, other = (
        predict(robot, GAITS["wave"], SURFACES["gelatin"], "lifted", 8).locomotion.per_cycle
        for robot in (Robot(), Robot(actuator=STRAIGHT))
    )
    assert other == pytest.approx(one, rel=1e-9)


def test_limbs_have_curves_of_their_own():
    robot = as_strip(Robot(actuator=SOFT))
    assert [limb.strip.actuators for limb in robot.limbs] == [(SOFT,)] * 3


def test_materials_are_moduli():
    assert Robot(material="ecoflex-00-30").modulus == MATERIALS["ecoflex-00-30"] == 48e3
    with pytest.raises(ValueError, match=r"material must be one of .*; got 'felt'"):
        Robot(material="felt")
    with pytest.raises(ValueError, match="material or modulus must be given, not both"):
        Robot(material="ecoflex-00-30", modulus=2e6)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (((0, 1e3, 1e3), (0, 1, 2)), "pressure must rise .*, got 1000 Pa after 1000 Pa"),
        (((0, 1e3, 2e3), (0, 2, 1)), "must not fall .*, got 1 1/m at 2000 Pa after 2 1/m"),
        (((0, 1e3), (1, 2)), "curvature must be 0 without pressure"),
        (((0, 1e3), (0, 1, 2)), "curvature must be 2 numbers"),
        (((0, float("nan")), (0, 1)), "pressure must be finite"),
        (((0, 1e3), (0, 1), (1e-4,)), "rigidity must be 2 numbers"),
        (((0, 1e3), (0, 1), (1e-4, -1)), "rigidity must be a positive"),
        (((0, 1e3), (0, 1), None, (1e2,)), "share must be 1 numbers"),
        (((0, 1e3), (0, 1), None, (1e2, 2e2), (0.6, 0.5)), "together 1 at most, got 1.1"),
        ((("0 kPa", "30 V"), (0, 1)), "pressure"),
    ],
)
def test_what_is_no_actuator_is_refused(values, message):
    with pytest.raises(ValueError, match=message):
        Actuator(*values)


def test_a_gait_is_told_by_how_much_it_bends_not_by_its_pressures():
    from analytic import GAITS, Gait

    held = Gait("held", ((0.3, 0, 0), (0.3, 1, 0), (0.3, 1, 1), (0.3, 0, 0)))
    soft = Robot(actuator=Actuator((0, 0.25 * PEAK, PEAK), (0, 1.0, 25.0)))
    assert not held.between()
    assert as_bent(Robot(), held) is held
    assert as_bent(soft, held).between()  # its left end hardly bends
    unlike = tuple(Actuator((0, PEAK), (0, 20.0), play=(r * PEAK,), share=(0.3,))
                   for r in (0.1, 0.3, 0.2))  # fmt: skip
    for gait in GAITS.values():
        assert as_bent(Robot(actuator=STRAIGHT), gait).between() == gait.between()
        assert as_bent(Robot(actuator=unlike), gait).between() == gait.between()


def test_a_segment_that_no_pressure_bends_is_told_as_straight():
    from analytic import Gait

    straight = Actuator((0, PEAK), (0, 0.0))
    robot = Robot(actuator=(straight, Actuator((0, PEAK), (0, 20.0)), straight))
    told = as_bent(robot, Gait("switch", ((0, 0, 0), (1, 0, 1), (1, 1, 1)), 1.0, False)).stages
    assert {row[0] for row in told} == {row[2] for row in told} == {0.0}
    assert told[-1] == (0.0, 1.0, 0.0)
