"""What walking is measured on, and what it should come to; needs no MuJoCo.

The default gait on level ground, its legs so slow that the quasi-static reference is what a method
should find: what is measured is its numerical error, and not what inertia does at 2 s a leg.
"""

from dataclasses import replace
from functools import cache

from analytic import SURFACES, predict
from mjsim.accuracy.rows import Row, row
from mjsim.accuracy.setting import Setting
from mjsim.accuracy.timing import Timing
from mjsim.config import Scene

WALK, COULOMB = "walk", "coulomb"
GROUNDS = {WALK: ("felt", "gelatin"), COULOMB: ("gelatin",)}  # Coulomb's law leaves felt undecided
FAR = 0.5  # relative error of a displacement that is none; chosen
_LEG = 16.0  # s; chosen, inertia is below 0.1 % by then, and below 0.4 % under Coulomb's law


def scene_of(work: str, ground: str, body: str = "planar") -> Scene:
    """A work's scene on a ground: the paper's law, or one that other engines know as well.

    That is Coulomb's, with chambers at constant pressure: the rest curvature alone follows them.
    """
    scene = Scene(surface=SURFACES[ground], body=body)
    scene = replace(scene, gait=replace(scene.gait, leg_time=_LEG))
    return replace(scene, friction="coulomb", gas="open") if work == COULOMB else scene


@cache
def exact(work: str, ground: str) -> float:
    """Displacement per cycle over L of the elastica, twice as fine as usual."""
    scene = scene_of(work, ground)
    walk = predict(scene.robot, scene.gait, scene.surface, n_per_leg=100, links=120,
                   friction=scene.hold, gas=scene.gas)  # fmt: skip
    return walk.locomotion.per_cycle / scene.robot.length


def walked(
    work: str, ground: str, setting: Setting, value: float, timing: Timing, status: str
) -> Row:
    """The row of a displacement per cycle over L; one that is FAR off is no walk of this gait."""
    reference = exact(work, ground)
    error = abs(value / reference - 1)
    if status == "ok" and error > FAR:
        status = "drifting"
    return row(work, ground, setting, value, reference, error, timing, status)
