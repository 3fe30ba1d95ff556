"""TerreSoRo-IV's limbs as a scene that walks: `python -m zoo.terresoro_iv.scenes`.

A limb has two chambers: the first curls it, the second bends nothing and switches a foot at its
tip, which is damped as a limb is that stays flat, stays curled, curls or uncurls. Each transition
is a switch and a ramp. Writes scene.toml, gait C, and prints the gaits, and all 240 transitions in
one tour, by `limbs`, by the product's theory for weak friction, by the reference, in which friction
bends limbs, and by MuJoCo.
"""

import tomllib
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple, cast

import numpy as np

from analytic.scene.actuator import Actuator
from analytic.solvers.limbs.walk import walk
from mjsim import Numerics, Scene, build, simulate
from mjsim.files.scene_tables.tables import Tables
from studies import Array
from zoo.terresoro_iv.fit import explained, wrong_order
from zoo.terresoro_iv.hub import HERE, LIMBS, gaits, measured_cycles, turned
from zoo.terresoro_iv.limbs import (
    ELEMENTS,
    PEAK,
    TIP_FORCE,
    Laid,
    Walker,
    hub_of,
    lay,
    robot,
)
from zoo.terresoro_iv.model import Lagged, amounts, recut, recut_gaits, remembered, steady

TIP = 0.02  # part of a limb's length that the second chamber has; chosen
SWITCH, RAMP = 0.1, 6.0  # s, chosen; damping is that of a ramp of 0.45 s, over the time
STATES = 8  # of a change by the peak pressure, by theory
NUMERICS = Numerics(links=ELEMENTS, timestep=0.01, twists=0)
_AT_AN_END = 2  # limbs that begin at one end of the hub, which share a tip's bound by their widths


class Hubs(NamedTuple):
    """Where the hub is along a walk: times (B,) [s], places (B, 2) [cm], headings (B,) [rad]."""

    times: Array
    places: Array
    headings: Array

    def at(self, times: Array) -> tuple[Array, Array]:
        """Places (T, 2) [cm] and headings (T,) [rad] at times [s]."""
        places = [np.interp(times, self.times, column) for column in self.places.T]
        return np.stack(places, axis=1), np.interp(times, self.times, self.headings)


def stages(numbers: Lagged, laid: Laid, past: Array, after: Array) -> Array:
    """Fractions of the peak pressure along transitions, (2 T + 1, 9): hub, then curl and damping.

    Args:
        numbers: of `model`.
        laid: its limbs.
        past, after: states of T transitions that follow one another, (T, P, 4) and (T, 4).
    """
    begin, end = amounts(past, after, numbers.lag)
    damped = numbers.factors(past[:, -1], after)
    damped = damped / strongest(numbers)
    rows = [_row(laid.pressures(begin[0]), damped[-1])]
    for k in range(len(after)):
        rows += [_row(laid.pressures(begin[k]), damped[k]), _row(laid.pressures(end[k]), damped[k])]
    return np.array(rows)


def strongest(numbers: Lagged) -> float:
    """Greatest resistance of a tip over that of a flat limb."""
    return float(np.exp(max(0.0, numbers.resting, numbers.curling, numbers.uncurling)))


def _row(pressures: Array, damped: Array) -> Array:
    return np.concatenate([[0.0], np.column_stack([pressures[1:] / PEAK, damped]).ravel()])


def scene(numbers: Lagged, laid: Laid, rows: Array, cycles: int) -> str:
    """The text of a scene file."""
    lines = [
        "# TerreSoRo-IV as a robot of limbs: `python -m zoo.terresoro_iv.scenes` writes it.",
        "# Of each limb the first chamber curls it, the second switches the damping of its tip.",
        "", "[robot]", f"peak_pressure = {PEAK:g}", "",
    ]  # fmt: skip
    damping = TIP_FORCE * strongest(numbers) * np.exp(numbers.viscous) * 100 * RAMP
    for limb in robot(laid).limbs:
        strip, curve = limb.strip, cast(Actuator, limb.strip.actuator)
        lines += ["[[robot.limbs]]", f'name = "{limb.name}"']
        curves = [_curve(curve)]
        if limb.on:
            lines += [f'on = "{limb.on}"', f'at = "{limb.at}"',
                      f"angle_deg = {np.degrees(limb.angle):.6g}",
                      f"offset = {limb.offset:.6g}", f"segments = [{1 - TIP:g}, {TIP:g}]",
                      "feet = [{ begin = 1.0, end = 1.0, damping = "
                      f'{damping:.6g}, chamber = "{limb.name}-2" }}]']  # fmt: skip
            curves.append(_curve(Actuator(curve.pressure, (0.0, 0.0), curve.rigidity)))
        lines += [f"length = {strip.length:.6g}", f"width = {strip.width:g}",
                  f"weight_per_length = {strip.weight_per_length:.6g}",
                  f"actuator = [{', '.join(curves)}]", ""]  # fmt: skip
    lines += ["[gait]", "stages = ["]
    lines += ["    [" + ", ".join(f"{x:.6g}" for x in row) + "]," for row in rows]
    lines += ["]", f"ramp_time = {[SWITCH, RAMP] * (len(rows) // 2)}", "", "[ground]",
              'surface = "mat"', f"tip_force = {_AT_AN_END * TIP_FORCE:.6g}", "", "[numerics]",
              f"cycles = {cycles}", f"links = {ELEMENTS}", "twists = 0"]  # fmt: skip
    return "\n".join(lines) + "\n"


def _curve(curve: Actuator) -> str:
    """A table of a file."""
    parts = (f"{name} = [{', '.join(f'{x:.6g}' for x in getattr(curve, name))}]"
             for name in ("pressure", "curvature", "rigidity"))  # fmt: skip
    return "{ " + ", ".join(parts) + " }"


def by_theory(text: str, cycles: int = 2, bent: bool = False) -> Hubs:
    """The walk of a scene by the product's theory, where friction bends limbs or not."""
    made = built(text)
    path = walk(made.robot, made.gait, made.ground, states=STATES, elements=ELEMENTS, twists=0,
                bent=bent, cycles=cycles)  # fmt: skip
    rows = [hub_of(rest.nodes) for rest in path.rests]
    turns = np.zeros(len(rows)) if bent else path.heading
    moves = np.zeros((len(rows), 2)) if bent else path.place
    places = [move + turned(middle[:2], turn)
              for move, turn, (middle, _) in zip(moves, turns, rows, strict=True)]  # fmt: skip
    headings = turns + np.array([heading for _, heading in rows])
    return Hubs(path.times, 100 * np.array(places), np.unwrap(headings))


def by_mujoco(text: str) -> tuple[Hubs, str]:
    """The same by MuJoCo, and the walk's status."""
    walked = simulate(built(text), NUMERICS)
    hub = walked.position[:, 0]
    along = hub[:, -1, :2] - hub[:, 0, :2]
    heading = np.unwrap(np.arctan2(along[:, 1], along[:, 0]))
    places = 50 * (hub[:, -1, :2] + hub[:, 0, :2])
    return Hubs(walked.time, places, heading), str(walked.status)


def built(text: str) -> Scene:
    """The scene of a text."""
    return build(cast(Tables, tomllib.loads(text)))[0]


def last_cycle(hubs: Hubs, transitions: int) -> Array:
    """Distance [cm] and turn [deg] of the last cycle of a gait of so many transitions."""
    end = hubs.times[-1]
    places, headings = hubs.at(np.array([end - transitions * (SWITCH + RAMP), end]))
    return np.array([np.hypot(*(places[1] - places[0])), np.degrees(headings[1] - headings[0])])


def motions_of(hubs: Hubs, laid: Laid, count: int) -> Array:
    """Displacements in the hub's frame and turns of a tour's transitions, (T, 3) [cm, cm, deg]."""
    times = hubs.times[-1] - (SWITCH + RAMP) * np.arange(count, -1, -1)
    places, headings = hubs.at(times)
    turns = laid.axis - headings[:-1]
    steps = [turned(*pair) for pair in zip(np.diff(places, axis=0), turns, strict=True)]
    return np.column_stack([steps, np.degrees(np.diff(headings))])


def tour() -> list[str]:
    """All 16 states in an order that goes once through each of the 240 transitions (Hierholzer)."""
    states = [format(number, "04b") for number in range(2**LIMBS)]
    left = {state: [other for other in states if other != state] for state in states}
    way, done = [states[0]], []
    while way:
        if left[way[-1]]:
            way.append(left[way[-1]].pop())
        else:
            done.append(way.pop())
    return done[::-1]


def of_tour(states: Sequence[str]) -> tuple[Array, Array]:
    """Pasts (T, 4, 4) and states after (T, 4) of a tour's transitions, which begins at rest."""
    each = np.array([[int(digit) for digit in state] for state in states])
    at = np.arange(len(each) - 1)[:, None] - np.arange(3, -1, -1)
    return each[np.maximum(at, 0)], each[1:]


def main() -> None:
    """Write scene.toml, and print gaits and transitions."""
    numbers = Lagged(*remembered()[0])
    laid, walker = lay(numbers), Walker(numbers)
    mean, error = measured_cycles(recut_gaits())
    print("| gait | measured | limbs | theory | reference | MuJoCo |")
    print("|---|---|---|---|---|---|")
    found = []
    for one, measured in zip(gaits(), mean, strict=True):
        text = scene(numbers, laid, stages(numbers, laid, *steady(one.states)), 2)
        if one.name == "C":
            (HERE / "scene.toml").write_text(text, encoding="utf-8")
        walked, status = by_mujoco(text)
        count = len(one.states)
        found.append([walker.cycle(one.states), last_cycle(by_theory(text), count),
                      last_cycle(by_theory(text, bent=True), count),
                      last_cycle(walked, count)])  # fmt: skip
        shown = " | ".join(f"{cell[0]:.2f}, {cell[1]:+.1f}" for cell in (measured, *found[-1]))
        print(f"| {one.name} | {shown} | {status}", flush=True)
    names = "limbs", "theory", "reference", "MuJoCo"
    for name, cells in zip(names, np.array(found).swapaxes(0, 1), strict=True):
        off = np.sqrt(((cells - mean) ** 2).mean(axis=0))
        print(name, "rms", off.round(2), "wrong order", wrong_order(cells, mean, error))
    pairs, means = recut()
    states = tour()
    past, after = of_tour(states)
    text = scene(numbers, laid, stages(numbers, laid, past, after), 1)
    order = [pairs.index(pair) for pair in pairwise(states)]
    walked, status = by_mujoco(text)
    for name, motions in (
        ("limbs", walker(past, after)),
        ("theory", motions_of(by_theory(text, 1), laid, len(after))),
        ("reference", motions_of(by_theory(text, 1, bent=True), laid, len(after))),
        (f"MuJoCo, {status}", motions_of(walked, laid, len(after))),
    ):
        print(name, "R2 of 240 transitions", explained(motions, means[order]).round(2), flush=True)


if __name__ == "__main__":
    main()
