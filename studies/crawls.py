"""Speed of the fastest crawls of the quadruped on several grounds: `python -m studies.crawls`.

A crawl presses one leg at a time, or two that are diagonal, the torso flat, pressed between two
legs, or pressed all the time; a leg may be pressed before the one before it is released. All are
walked coarsely at 1 s a ramp; the one that goes farthest is walked again at several speeds as a run
would, in its second cycle, and by the reference, beside the wave. Legs are named rl, rr, fl, fr.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import permutations, product

import numpy as np

from analytic.scene import pneunet
from analytic.scene.gait import Gait
from analytic.scene.limbs import ORDER, quadruped
from analytic.scene.quadruped_gaits import undulation
from analytic.scene.surface import SURFACES, Surface
from mjsim.results.measures import measure
from mjsim.results.prediction import reference
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate

GROUNDS = (
    *((surface, "constant") for surface in SURFACES.values()),
    (Surface("rough sides", friction=0.6, tip_friction=0.2), "coulomb"),
    (Surface("rough tips", friction=0.2, tip_friction=0.6), "coulomb"),
    (Surface("smooth sides", friction=0.0, tip_friction=0.6), "coulomb"),
    (Surface("rough", friction=1.0, tip_friction=1.0), "coulomb"),
)
RAMPS = (2.0, 0.5, 0.25)  # s
PUBLISHED = 13e3 / 3600  # mm/s; 13 m/h
_SEARCH = Numerics(links=4, timestep=0.02, twists=0)
_USUAL = Numerics(twists=0)  # as the search, whose price twist doubles
_FEET = 3  # limbs on the ground at least, or it rocks
_TORSO = ("flat", "between", "pressed")


def crawls() -> Iterator[Gait]:
    """All crawls but for mirror images."""
    orders: list[list[tuple[str, ...]]] = [
        [(leg,) for leg in legs] for legs in permutations(ORDER[1:]) if legs[0].endswith("left")
    ]
    orders.append([("rear-left", "front-right"), ("rear-right", "front-left")])
    for order in orders:
        for torso, overlap in product(_TORSO, (False, True)):
            names = " ".join("+".join(map(_short, group)) for group in order)
            name = f"{names}, torso {torso}{', overlapping' * overlap}"
            yield Gait(name, _stages(order, torso, overlap), 1.0)


def _short(leg: str) -> str:
    """First letters of the two words of a leg's name."""
    end, side = leg.split("-")
    return end[0] + side[0]


def _stages(
    order: list[tuple[str, ...]], torso: str, overlap: bool
) -> tuple[tuple[float, ...], ...]:
    def row(legs: tuple[str, ...], between: bool) -> tuple[float, ...]:
        pressed = torso == "pressed" or (torso == "between" and between)
        return float(pressed), *(float(name in legs) for name in ORDER[1:])

    rows = [row((), False)] if torso != "pressed" else [row((), True)]
    for group, following in zip(order, [*order[1:], ()], strict=True):
        rows.append(row(group, False))
        if following and (overlap or torso == "between"):
            rows.append(row((*group, *following) if overlap else group, True))
    return (*rows, rows[0])


def moved(
    gait: Gait,
    surface: Surface,
    law: str,
    ramp: float,
    numerics: Numerics = _USUAL,
    cycles: int = 2,
) -> tuple[float, float]:
    """Displacement per cycle over L and speed [mm/s] of a gait; NaN where it fell or rocked."""
    scene = Scene(quadruped(), replace(gait, ramp_time=ramp), surface, friction=law, cycles=cycles)
    walk = simulate(scene, numerics)
    measures = measure(walk)
    if measures is None or walk.contacts[walk.start :].min() < _FEET:
        return float("nan"), float("nan")
    return measures.displacement, 1e3 * measures.speed


def main() -> None:
    """Search on each ground, and print a table of the best."""
    strip = quadruped().limbs[1].strip
    angle = float(pneunet.natural_curvature(strip, quadruped().peak_pressure)) * strip.length
    stroke = strip.length * angle**2 / 24  # by which its chord shortens, to second order
    print(f"a leg bends by {angle:.2f} rad and shortens by {1e3 * stroke:.1f} mm, "
          f"{stroke / quadruped().length:.4f} L")  # fmt: skip
    print(f"published: {PUBLISHED:.1f} mm/s\n")
    heads = " | ".join(f"{ramp:g} s" for ramp in RAMPS)
    columns = f"reference | {RAMPS[0]:g} s, finer | {heads}"
    print(f"| ground | gait | {columns} |\n|---|---" + "|---" * (2 + len(RAMPS)) + "|")
    for surface, law in GROUNDS:
        shifts = {gait: abs(moved(gait, surface, law, 1.0, _SEARCH, 1)[0]) for gait in crawls()}
        best = max(shifts, key=lambda gait: np.nan_to_num(shifts[gait]))
        for gait in (best, undulation("wave")):
            print(row(gait, surface, law), flush=True)


def row(gait: Gait, surface: Surface, law: str) -> str:
    """Line of the table: by the reference, by twice the links and half the steps, at RAMPS."""
    scene = Scene(quadruped(), replace(gait, ramp_time=RAMPS[0]), surface, friction=law)
    usual = resolved(scene, _USUAL)
    fine = Numerics(2 * usual.links, 0.5 * usual.timestep, twists=0)
    ahead = float(reference(scene, _USUAL).displacement[0])
    shift, _ = moved(gait, surface, law, RAMPS[0], fine)
    cells = [f"{ahead:+.4f} L", f"{shift:+.4f} L"]
    for ramp in RAMPS:
        shift, speed = moved(gait, surface, law, ramp)
        cells.append(f"{shift:+.4f} L, {speed:+.2f} mm/s")
    return f"| {surface.name} | {gait.name} | {' | '.join(cells)} |"


if __name__ == "__main__":
    main()
