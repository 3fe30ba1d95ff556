"""Hold a redesign to the numbers recorded before it: `make regression`.

    check.py [NAMES]            walk the recorded scenes, those whose name holds a word of NAMES
    check.py --record [NAMES]   record scenes that are not recorded yet, and those named

Theory within 1e-9 L, MuJoCo within 1e-6 L, turns alike in radians; a scene that scatters by more
when its weight changes by 1e-8 of itself, within ten times that. A run that failed fails in the
same way at the same time. Prints what differs and leaves with 1 if anything does. A row's `awaits`
says what its number is known to lack.
"""

import json
import math
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import limbs
import numpy as np
import strips

from analytic import SOLVERS, Elastica, Friction, Gait, Robot, Surface, predict
from analytic.scene.limbs import limbs_of, rotation
from analytic.solvers.limbs.walk import walk as walk_of_limbs
from mjsim.files.scene_tables.tables import build
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene, Valves
from mjsim.simulation.simulation import simulate

Case = dict[str, Any]
Row = dict[str, Any]

NUMBERS = Path(__file__).with_name("numbers.json")
THEORY, MUJOCO = 1e-9, 1e-6  # over L
SAME_TIME = 0.011  # s; steps
ROUNDED = 0.25  # of the number of states, which the rounding of another processor changes
CHANGE, SCATTERS = 1e-8, 10.0  # of the weight, to see scatter by; of it, that a bound is
STATES = 8  # of the theory of limbs, in a change by the peak pressure
ROWS = {"theory": THEORY, "mujoco": MUJOCO}


def quasi_static(case: Case, robot: Robot, gait: Gait) -> Row:
    solver = SOLVERS[case["model"]]()
    if case["model"] == "elastica":
        solver = Elastica(case["numerics"].get("links", 60), case["chamber"])
    tension = 1.0 if case["bends"] else 0.0
    friction = Friction(case["friction"], tension, case["slope"])
    walk = predict(robot, gait, Surface("any", **case["ground"]), solver, friction=friction)
    shapes, length = walk.shapes, robot.length
    travel = walk.locomotion.per_cycle / length
    contact = np.nansum(shapes.contact_left) + np.nansum(shapes.contact_right)
    return {
        "displacement": None if math.isnan(travel) else travel,
        "amplitude": float(np.nanmax(shapes.amplitude)) / length,
        "separation": float(np.nanmin(shapes.separation)) / length,
        "contact": float(contact) / length / len(shapes),
        "status": "+".join(f.name.lower() for f in walk.flags if f.name) or "ok",
        "states": len(shapes),
    }


def simulated(case: Case, robot: Robot, gait: Gait) -> Row:
    scene = Scene(
        robot, gait, Surface("any", **case["ground"]), cycles=case["cycles"],
        body={"planar": "chain"}.get(case["model"], case["model"]),
        friction=case["friction"], slope=case["slope"], chamber=case["chamber"],
        valves=Valves(case["lag"]),
        actuation={"springs": "rest-angles"}.get(case["actuation"], case["actuation"]),
    )  # fmt: skip
    numerics = Numerics(tie_bound=case["phi"], **case["numerics"])
    walk = simulate(scene, numerics)
    row: Row = {"status": str(walk.status), "end_time": float(walk.time[-1])}
    numbers = measure(walk)
    if numbers:
        x = walk.line[:, :, 0]
        row |= {
            "displacement": numbers.displacement,
            "amplitude": numbers.amplitude,
            "separation": float((x[:, -1] - x[:, 0]).min()) / robot.length,
            "contact": float(np.nanmean(walk.contact_left + walk.contact_right)) / robot.length,
        }
    return row


def of_strip(case: Case, change: float = 0.0) -> dict[str, Row]:
    weight = case["robot"]["weight_per_length"] * (1 + change)
    robot = Robot(**{**case["robot"], "weight_per_length": weight})
    gait = Gait("any", tuple(map(tuple, case["stages"])), case["ramp"])
    if case["model"] in ("modes", "obstacle", "elastica"):
        return {"theory": quasi_static(case, robot, gait)}
    return {"mujoco": simulated(case, robot, gait)}


def of_limbs(case: Case, change: float = 0.0) -> dict[str, Row]:
    tables = {**case["tables"], "numerics": {**case["tables"]["numerics"],
                                             "links": case["hinges"]}}  # fmt: skip
    scene, numerics = build(tables)
    limbs_heavier = tuple(
        replace(limb, strip=_heavier(limb.strip, change)) for limb in limbs_of(scene.robot)
    )
    robot = (replace(scene.robot, limbs=limbs_heavier) if scene.in_space
             else limbs_heavier[0].strip)  # fmt: skip
    scene = replace(scene, robot=robot)
    rows = {"mujoco": simulated_limbs(scene, numerics)}
    if case["theory"]:
        length, twists = rows["mujoco"]["length"], numerics.twists
        rows["theory"] = quasi_static_limbs(scene, case["hinges"], length, twists)
    return rows


def _heavier(strip: Robot, change: float) -> Robot:
    return replace(strip, weight_per_length=(1 + change) * strip.weight_per_length)


def simulated_limbs(scene: Scene, numerics: Numerics) -> Row:
    walk = simulate(scene, numerics)
    length = scene.robot.length
    row: Row = {"status": str(walk.status), "end_time": float(walk.time[-1]), "length": length}
    numbers = measure(walk)
    if numbers:
        row |= {"displacement": numbers.displacement, "sideways": numbers.aside,
                "turn": numbers.turn,
                "height": float(walk.coordinates[:, 2].max()) / length if scene.in_space
                else numbers.amplitude}  # fmt: skip
    return row


def quasi_static_limbs(scene: Scene, hinges: int, length: float, twists: int) -> Row:
    path = walk_of_limbs(scene.robot, scene.gait, scene.ground, STATES, hinges, law=scene.friction,
                         twists=twists)  # fmt: skip
    ahead, aside = (path.displacement @ rotation(scene.robot.limbs[0].angle) / length).tolist()
    return {"displacement": ahead, "sideways": aside, "turn": float(path.turn),
            "height": max(float(rest.q[2]) for rest in path.rests) / length,
            "status": "ok" if path.converged else "unconverged",
            "states": len(path.rests)}  # fmt: skip


FAMILIES: dict[str, tuple[Callable[..., Any], Callable[..., dict[str, Row]]]] = {
    "strips": (strips.cases, of_strip),
    "limbs": (limbs.cases, of_limbs),
}


def scatter(one: Row, two: Row) -> float:
    """Largest difference of two rows' numbers."""
    keys = [key for key in one if isinstance(one[key], float) and key not in ("end_time", "length")]
    return max((abs(one[key] - two.get(key, math.nan)) for key in keys), default=0.0)


def recorded(result: Callable[..., dict[str, Row]], case: Case) -> Row:
    """Numbers of a scene, and the bounds to hold them to."""
    rows = result(case)
    others = [result(case, change) for change in (-CHANGE, CHANGE)]
    bounds = {
        name: max(ROWS[name], SCATTERS * max(scatter(row, other[name]) for other in others))
        for name, row in rows.items()
    }
    return {**rows, "bounds": bounds, "awaits": list(case.get("awaits", ()))}


def differences(name: str, before: Row, now: Row, bound: float) -> list[str]:
    lines = []
    for key in before.keys() | now.keys():
        one, two = before.get(key), now.get(key)
        if isinstance(one, float) and isinstance(two, float):
            limit = SAME_TIME if key == "end_time" else bound
            if key == "end_time" and now["status"] == "diverged":
                continue  # when it diverges is a matter of rounding, that it does is not
            if abs(one - two) <= limit:
                continue
        elif one == two or (key == "states" and abs(one - two) <= ROUNDED * one):
            continue
        lines.append(f"{name}: {key} was {one}, is {two} (bound {bound:.1e})")
    return lines


def main(words: list[str]) -> int:
    record = words[:1] == ["--record"]
    words = words[1:] if record else words
    numbers = json.loads(NUMBERS.read_text()) if NUMBERS.is_file() else {}
    lines, count, names = [], 0, set()
    for cases, result in FAMILIES.values():
        for name, case in cases():
            names.add(name)
            named = any(word in name for word in words)
            if record and (named or name not in numbers):
                numbers[name] = recorded(result, case)
                print(f"{name}: recorded, bounds {numbers[name]['bounds']}", flush=True)
            elif name in numbers and not record and (named or not words):
                count += 1
                before, now = numbers[name], result(case)
                for kind in before["bounds"].keys() | now.keys():
                    bound = before["bounds"].get(kind, 0.0)
                    rows = before.get(kind, {}), now.get(kind, {})
                    lines += differences(f"{name}, {kind}", *rows, bound)
    if not record:
        lost = [name for name in numbers if name not in names]
        new = [name for name in names if name not in numbers]
        lines += [f"{name}: recorded, but no scene" for name in lost]
        lines += [f"{name}: a scene, but not recorded" for name in new]
        lines += [f"no scene has {word!r} in its name" for word in words
                  if not any(word in name for name in names)]  # fmt: skip
    if record:
        NUMBERS.write_text(json.dumps(numbers, indent=1) + "\n")
    print(*lines, f"{count} scenes, {len(lines)} differences", sep="\n")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
