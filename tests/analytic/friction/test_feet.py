"""Feet of strips: ground that is scaled, closed forms, and what is no foot."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from analytic import GAITS, SURFACES, Friction, Gait, Patches, Robot, predict
from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS
from analytic.scene.feet import Foot
from analytic.scene.surface import Surface
from analytic.solvers.elastica.tractions import tractions

GROUND = SURFACES["polyethylene"]
LENGTH = Robot().length
ARCH = Gait("arch", ((0, 0, 0), (1, 1, 1), (0, 0, 0)))
eighths = st.integers(1, 16).map(lambda i: i / 8)
rising = st.lists(eighths, min_size=2, max_size=2, unique=True).map(sorted)
WAYS = [
    Friction(), Friction("coulomb"), Friction(contacts="all"), Friction(tension=1.0),
    Friction(tension=1.0, contacts="all"),
]  # fmt: skip


def shod(*feet, **values):
    return Robot(feet=feet, **values)


def bounds_of(
    strip, begin, end, pressures=(0.0, 0.0, 0.0), ground=GROUND, load=0.0, law="constant"
):
    """Ahead and back, of a contact between two places over the length."""
    begin, end = begin * LENGTH, end * LENGTH
    return Grip(strip, LAWS[law]).both_ways(ground, end - begin, load, (begin, end), pressures)


@pytest.mark.parametrize("friction", WAYS)
def test_a_foot_everywhere_is_ground_that_is_scaled(friction):
    """By a power of two, which rounds nothing."""
    strip, ways = Robot(), []
    for robot, ground in ((shod(Foot(0, 1, grip=2.0)), GROUND), (strip, GROUND.scaled(2.0))):
        path = predict(robot, GAITS["wave"], ground, friction=friction, states_per_ramp=4)
        ways.append(path.locomotion.left)
    assert np.array_equal(*ways)


def test_a_foot_everywhere_that_is_unlike_back_is_a_nap():
    def napped(surface):
        keys = ("tip_force", "shear_strength")
        return replace(surface, **{f"{key}_back": 2.0 * getattr(surface, key) for key in keys})

    felt = SURFACES["felt"]
    patches = Patches("two", (0.5 * LENGTH,), (GROUND, felt))
    napped_patches = replace(patches, surfaces=(napped(GROUND), napped(felt)))
    shoe = shod(Foot(0, 1, grip_back=2.0))
    for ground, scaled in ((GROUND, napped(GROUND)), (patches, napped_patches)):
        ways = [predict(robot, GAITS["wave"], under, states_per_ramp=6).locomotion.per_cycle
                for robot, under in ((shoe, ground), (Robot(), scaled))]  # fmt: skip
        assert ways[0] == ways[1]


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("end", [0.0, 1.0])
def test_a_tip_on_a_claw_resists_by_its_ground_and_all_of_the_claw(law, end):
    load = 0.03
    plain = bounds_of(Robot(), end, end, load=load, law=law)[0]
    for foot in (Foot(end, end, hold="20 mN"), Foot(0.9 * end, 0.9 * end + 0.1, hold=0.02)):
        bounds = bounds_of(shod(foot), end, end, load=load, law=law)
        assert bounds == (plain + 0.02, plain + 0.02)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("end", [0.0, 1.0])
def test_a_tip_on_a_point_of_a_foot_resists_as_on_a_foot_of_any_length(law, end):
    near = (0.9 * end, 0.9 * end + 0.1)
    point, pad = (Foot(*where, grip=0.5, grip_back=3.0) for where in ((end, end), near))
    bounds = [bounds_of(shod(foot), end, end, load=0.03, law=law) for foot in (point, pad)]
    assert bounds[0] == bounds[1] != bounds_of(Robot(), end, end, load=0.03, law=law)
    begin = min(end, 0.75)  # a side covers none of the point
    sides = [bounds_of(strip, begin, begin + 0.25, load=0.03, law=law)
             for strip in (shod(point), Robot())]  # fmt: skip
    assert sides[0] == pytest.approx(sides[1], rel=1e-12)


@given(eighths, eighths, st.integers(0, 7), st.integers(1, 8))
def test_a_side_resists_by_the_sum_over_what_it_covers(grip, back, first, count):
    """Summed over short pieces, each bare or on the foot, which lies between 1/4 and 5/8."""
    begin, end = first / 8, min(first + count, 8) / 8
    strip = shod(Foot(0.25, 0.625, grip=grip, grip_back=back, hold=0.03))
    middles = begin + (end - begin) * (np.arange(960) + 0.5) / 960
    on = (middles > 0.25) & (middles < 0.625)
    piece = GROUND.shear_strength * strip.width * LENGTH * (end - begin) / 960
    held = 0.03 / (0.375 * 960) * (end - begin)
    ahead, back_bound = bounds_of(strip, begin, end)
    assert ahead == pytest.approx(np.sum(np.where(on, grip * piece + held, piece)), rel=2e-3)
    assert back_bound == pytest.approx(np.sum(np.where(on, back * piece + held, piece)), rel=2e-3)


@pytest.mark.parametrize(
    ("pressure", "part"), [(0.0, 0.0), (0.25, 0.25), (1.0, 1.0), (1.5, 1.0), (-0.5, 0.0)]
)
def test_a_chamber_switches_its_foot_between_bare_ground_and_all_of_it(pressure, part):
    strip = shod(Foot(0.8, 1, grip=3.0, hold=0.01, chamber="right"))
    pressures = (0.0, 0.0, pressure * strip.peak_pressure)
    ahead, _ = bounds_of(strip, 1.0, 1.0, pressures)
    assert ahead == pytest.approx((1 + 2 * part) * GROUND.tip_force + 0.01 * part)


@given(rising, rising, st.sampled_from([2.0, 8.0, np.inf]))
def test_two_feet_and_a_spring_lose_of_their_stretch_what_the_lesser_feet_hold(
    out, back_in, stiffness
):
    """max(0, D - (min(a_left, b_right) + min(b_left, a_right)) / k); all of D if rigid."""
    (a_left, b_right), (a_right, b_left) = out, back_in
    strip = shod(Foot(0, 0.1, a_left, b_left), Foot(0.9, 1, a_right, b_right))
    unit = Surface("unit", tip_force=1.0)
    ahead, back = np.array([bounds_of(strip, end, end, ground=unit) for end in (0.0, 1.0)]).T
    compliance = np.array([[0.0, 0.0], [0.0, 1.0 / stiffness]])
    stretch, place, slips, starts = np.array([0.0, 1.0]), np.zeros(2), None, []
    rise = np.linspace(0.0, 1.0, 21)
    for number, part in enumerate(np.tile(np.append(rise[1:], rise[-2::-1]), 2)):
        if number % 40 == 0:
            starts.append(place[0])
        solution = tractions(part * stretch - place, compliance, ahead, np.zeros(2), guess=slips,
                          back=back)  # fmt: skip
        place = part * stretch + solution.whole + compliance @ solution.traction
        slips = solution.slips
    lost = (min(a_left, b_right) + min(b_left, a_right)) / stiffness
    assert place[0] - starts[-1] == pytest.approx(max(0.0, 1.0 - lost), abs=1e-4)


def test_a_stiff_crawler_on_directional_feet_goes_by_its_whole_shortening():
    crawler = shod(Foot(0, 0.1, grip_back=2.0), Foot(0.9, 1, grip_back=2.0), segments=(1.0,),
                   peak_pressure=2e4)  # fmt: skip
    gait, ground = Gait("breath", ((0,), (1,), (0,))), Surface("smooth", 0.01)
    walk = predict(crawler, gait, ground)
    whole = np.ptp(walk.shapes.separation)
    assert walk.locomotion.per_cycle == pytest.approx(whole, rel=1e-6)
    bent = [
        predict(crawler, gait, ground.scaled(part), friction=Friction(tension=1.0)).locomotion
        for part in (1.0, 0.5)
    ]
    off = [whole - locomotion.per_cycle for locomotion in bent]
    assert off[0] == pytest.approx(2.0 * off[1], rel=0.05)  # by the bound over a stiffness
    turned = replace(
        crawler, feet=[replace(foot, grip=2.0, grip_back=1.0) for foot in crawler.feet]
    )
    assert predict(turned, gait, ground).locomotion.per_cycle == pytest.approx(-whole, rel=1e-6)


def inchworm():
    anchors = Foot(0, 0, hold=0.05, chamber="left"), Foot(1, 1, hold=0.05, chamber="right")
    stages = (0, 0, 0), (0, 0, 1), (0, 1, 1), (1, 1, 0), (1, 0, 0), (0, 0, 0)
    return shod(*anchors, segments=(1, 6, 1)), Gait("inchworm", stages)


def test_an_arch_between_switched_anchors_nets_the_separation_from_swap_to_swap():
    """Flat, and arched at the place where both anchors hold alike."""
    robot, gait = inchworm()
    ground = Surface("slick", 0.01)
    states = robot.peak_pressure * np.array([[0, 0, 0], [0.5, 1, 0.5]])
    flat, arched = predict(robot, gait, ground, path=states).shapes.separation
    walk = predict(robot, gait, ground)
    assert walk.locomotion.per_cycle == pytest.approx(flat - arched, rel=1e-6)
    assert predict(robot, gait.reversed(), ground).locomotion.per_cycle == pytest.approx(
        arched - flat, rel=1e-6
    )


def test_modes_know_no_pressures_that_switch_feet():
    robot, _ = inchworm()
    with pytest.raises(ValueError, match="switches need the pressures"):
        predict(replace(robot, segments=(1, 1, 1)), GAITS["wave"], GROUND, "modes")


@pytest.mark.parametrize(("feet", "words"), [
    ([{"begin": 0, "end": 0.1}], "what it does: give grip, grip_back"),
    ([{"begin": 0.2, "end": 0.1, "grip": 2}], "end of a foot"),
    ([{"begin": 0.5, "end": 0.5, "grip": 2}], "point at an end"),
    ([{"begin": -0.1, "end": 0.5, "grip": 2}], "begin of a foot"),
    ([{"begin": 0, "end": 1, "grip": -1}], "grip of a foot"),
    ([{"begin": 0, "end": 1, "hold": "3 kg"}], "hold"),
    ([{"begin": 0, "end": 0.5, "grip": 2}, {"begin": 0.4, "end": 1, "grip": 2}], "not overlap"),
    ([{"begin": 0, "end": 0, "hold": 1}, {"begin": 0, "end": 1, "grip": 2}], "not overlap"),
    ([{"begin": 0, "end": 1, "grip": 2, "chamber": "midle"}], "did you mean middle"),
    ([{"begin": 0, "end": 1, "grib": 2}], "did you mean grip"),
    ([{"begin": 0}], "end of a foot is missing"),
    ([3], "feet must be Foot"),
    ("left", "feet must be Foot"),
])  # fmt: skip
def test_what_is_no_foot_is_refused_in_one_line(feet, words):
    with pytest.raises(ValueError, match=words):
        predict(Robot(feet=feet), ARCH, GROUND, states_per_ramp=1)
