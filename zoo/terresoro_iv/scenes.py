"""TerreSoRo-IV's limbs as a scene that walks: `python -m zoo.terresoro_iv.scenes`.

A limb has two chambers: the first curls it, the second bends nothing and switches a foot at its
tip, by which a tip that stays, that curls and that uncurls resist otherwise. Each transition is a
switch and a ramp. Writes scene.toml, gait C, and prints the gaits by `limbs`, by the reference and
by MuJoCo.
"""

import tomllib
from typing import cast

import numpy as np

from analytic.scene.actuator import Actuator
from analytic.solvers.limbs.walk import walk
from mjsim import Numerics, Scene, build, simulate
from mjsim.files.scene_tables.tables import Tables
from studies import Array
from zoo.terresoro_iv.hub import HERE, LIMBS, gaits, measured_cycles, turned
from zoo.terresoro_iv.limbs import (
    ELEMENTS,
    PEAK,
    STEPS,
    Numbers,
    cycle,
    known,
    robot,
)
from zoo.terresoro_iv.model import amounts, recut_gaits, steady

SHEAR = 10.0  # Pa, chosen: so weak that friction hardly bends limbs
GRIP = 0.02  # part of its pressure by which a tip that uncurls stands on it; chosen
TIP = 0.02  # part of a limb's length that the second chamber has; chosen
SWITCH, RAMP = 0.1, 2.0  # s, chosen
NUMERICS = Numerics(links=ELEMENTS, timestep=0.01, twists=0)
_AT_AN_END = 2  # limbs that begin at one end of the hub, which share a tip's bound by their widths


def stages(numbers: Numbers, past: Array, after: Array) -> Array:
    """Fractions of the peak pressure along transitions, (3 T + 1, 9): hub, then curl and grip.

    Args:
        numbers: of friction and lag.
        past, after: states of T transitions that follow one another, (T, P, 4) and (T, 4).
    """
    begin, end = amounts(past, after, numbers.lag)
    before = past[:, -1]
    low, high = _ends(numbers)
    resting, curling, uncurling = (max(GRIP, float((np.exp(x) - low) / (high - low)))
                                   for x in numbers[5:8])  # fmt: skip
    grip = np.where(after == 1, np.where(before == 1, resting, curling), uncurling * before)
    rows = [_row(begin[0], resting * before[0])]
    for k in range(len(after)):
        rows += [_row(begin[k], grip[k]), _row(end[k], grip[k]), _row(end[k], resting * after[k])]
    return np.array(rows)


def _ends(numbers: Numbers) -> tuple[float, float]:
    """Least and greatest bound of a tip over that of a flat limb."""
    bounds = np.exp(numbers[5:8])
    return float(bounds.min()), float(bounds.max())


def _row(curl: Array, grip: Array) -> Array:
    return np.concatenate([[0.0], np.column_stack([curl, grip]).ravel()])


def scene(numbers: Numbers, rows: Array, cycles: int) -> str:
    """The text of a scene file."""
    lines = [
        "# TerreSoRo-IV as a robot of limbs: `python -m zoo.terresoro_iv.scenes` writes it.",
        "# Of each limb the first chamber curls it, the second switches the foot at its tip.",
        "", "[robot]", f"peak_pressure = {PEAK:g}", "",
    ]  # fmt: skip
    of = robot(numbers)
    flat = SHEAR * of.limbs[1].strip.length * of.limbs[1].strip.width
    slack, most = (flat * end for end in _ends(numbers))
    for limb in of.limbs:
        strip, curve = limb.strip, cast(Actuator, limb.strip.actuator)
        lines += ["[[robot.limbs]]", f'name = "{limb.name}"']
        curves = [_curve(curve)]
        if limb.on:
            lines += [f'on = "{limb.on}"', f'at = "{limb.at}"',
                      f"angle_deg = {np.degrees(limb.angle):.6g}",
                      f"offset = {limb.offset:.6g}", f"segments = [{1 - TIP:g}, {TIP:g}]",
                      "feet = [{ begin = 1.0, end = 1.0, hold = "
                      f'{most - slack:.6g}, chamber = "{limb.name}-2" }}]']  # fmt: skip
            curves.append(_curve(Actuator(curve.pressure, (0.0, 0.0), curve.rigidity)))
        else:
            lines += ["feet = [{ begin = 0.0, end = 1.0, grip = 0.0 }]"]
        lines += [f"length = {strip.length:.6g}", f"width = {strip.width:g}",
                  f"weight_per_length = {strip.weight_per_length:.6g}",
                  f"actuator = [{', '.join(curves)}]", ""]  # fmt: skip
    times = [SWITCH if (rows[k, 1::2] == rows[k + 1, 1::2]).all() else RAMP
             for k in range(len(rows) - 1)]  # fmt: skip
    lines += ["[gait]", "stages = ["]
    lines += ["    [" + ", ".join(f"{x:.4g}" for x in row) + "]," for row in rows]
    lines += ["]", f"ramp_time = {times}", "", "[ground]", 'surface = "mat"',
              f"tip_force = {_AT_AN_END * slack:.6g}", f"shear_strength = {SHEAR:g}", "",
              "[numerics]",
              f"cycles = {cycles}", f"links = {ELEMENTS}", "twists = 0"]  # fmt: skip
    return "\n".join(lines) + "\n"


def _curve(curve: Actuator) -> str:
    """A table of a file."""
    parts = (f"{name} = [{', '.join(f'{x:.6g}' for x in getattr(curve, name))}]"
             for name in ("pressure", "curvature", "rigidity"))  # fmt: skip
    return "{ " + ", ".join(parts) + " }"


def by_reference(text: str) -> Array:
    """Distance [cm] and turn [deg] of the second cycle of a scene by the reference, not bent."""
    made = built(text)
    path = walk(made.robot, made.gait, made.ground, states=2 * STEPS, elements=ELEMENTS, twists=0,
                bent=False, cycles=2)  # fmt: skip
    half, last = len(path.rests[0].nodes) // 2, len(path.rests[0].nodes) // 2 // (LIMBS + 1) - 1
    middles = np.array([rest.nodes[[0, last, half, half + last], :2].mean(axis=0)
                        for rest in path.rests])  # fmt: skip
    places = path.place + np.array(
        [turned(one, angle) for one, angle in zip(middles, path.heading, strict=True)]
    )
    return _second(path.times, places, path.heading)


def by_mujoco(text: str) -> tuple[Array, str]:
    """The same by MuJoCo, and the walk's status."""
    walked = simulate(built(text), NUMERICS)
    hub = walked.position[:, 0]
    along = hub[:, -1, :2] - hub[:, 0, :2]
    heading = np.unwrap(np.arctan2(along[:, 1], along[:, 0]))
    places = 0.5 * (hub[:, -1, :2] + hub[:, 0, :2])
    return _second(walked.time, places, heading), str(walked.status)


def built(text: str) -> Scene:
    """The scene of a text."""
    return build(cast(Tables, tomllib.loads(text)))[0]


def _second(times: Array, places: Array, headings: Array) -> Array:
    middle = 0.5 * (times[0] + times[-1])
    begin = np.array([np.interp(middle, times, column) for column in places.T])
    turn = headings[-1] - np.interp(middle, times, headings)
    return np.array([100 * np.hypot(*(places[-1] - begin)), np.degrees(turn)])


def main() -> None:
    """Write scene.toml and print the gaits."""
    numbers, _ = known()
    mean, _ = measured_cycles(recut_gaits())
    print("| gait | measured | limbs | reference | MuJoCo |")
    print("|---|---|---|---|---|")
    for one, measured in zip(gaits(), mean, strict=True):
        text = scene(numbers, stages(numbers, *steady(one.states)), 2)
        if one.name == "C":
            (HERE / "scene.toml").write_text(text, encoding="utf-8")
        walked, status = by_mujoco(text)
        cells = [measured, cycle(one.states, numbers),
                 by_reference(text), walked]  # fmt: skip
        shown = " | ".join(f"{cell[0]:.2f}, {cell[1]:+.1f}" for cell in cells)
        print(f"| {one.name} | {shown} | {status}", flush=True)


if __name__ == "__main__":
    main()
