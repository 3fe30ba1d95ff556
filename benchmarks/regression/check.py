"""Hold a redesign to the numbers recorded before it: `make regression`.

Theory within 1e-9 L, MuJoCo within 1e-6 L; a run that failed fails in the same way at the same
time. Prints what differs and leaves with 1 if anything does. `--record` writes the numbers anew.
"""

import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
from cases import Case, cases

from analytic import SOLVERS, Elastica, Friction, Gait, Robot, Surface, predict
from mjsim.scene import Numerics, Scene, Valves
from mjsim.simulation.measures import measure
from mjsim.simulation.simulation import simulate

NUMBERS = Path(__file__).with_name("numbers.json")
THEORY, MUJOCO = 1e-9, 1e-6  # over L
SAME_TIME = 0.011  # s; steps
# scenes that scatter by as much when the weight or the friction is changed by 1e-8 of itself
SCATTER = {"rod coulomb polyethylene": 1e-3, "rod coulomb gelatin": 1e-3, "planar Euler": 1e-2}


def quasi_static(case: Case, robot: Robot, gait: Gait) -> dict[str, Any]:
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


def simulated(case: Case, robot: Robot, gait: Gait) -> dict[str, Any]:
    scene = Scene(
        robot, gait, Surface("any", **case["ground"]), cycles=case["cycles"], body=case["model"],
        friction=case["friction"], slope=case["slope"], chamber=case["chamber"],
        valves=Valves(case["lag"]),
        actuation={"springs": "rest-angles"}.get(case["actuation"], case["actuation"]),
    )  # fmt: skip
    numerics = Numerics(tie_bound=case["phi"], **case["numerics"])
    walk = simulate(scene, numerics)
    row: dict[str, Any] = {"status": str(walk.status), "end_time": float(walk.time[-1])}
    numbers = measure(walk)
    if numbers:
        x = walk.position[:, :, 0]
        row |= {
            "displacement": numbers.displacement,
            "amplitude": numbers.amplitude,
            "separation": float((x[:, -1] - x[:, 0]).min()) / robot.length,
            "contact": float(np.nanmean(walk.contact_left + walk.contact_right)) / robot.length,
        }
    return row


def result(case: Case) -> dict[str, Any]:
    robot = Robot(**case["robot"])
    gait = Gait("any", tuple(map(tuple, case["stages"])), case["ramp"])
    theory = case["model"] in ("modes", "obstacle", "elastica")
    return (quasi_static if theory else simulated)(case, robot, gait)


def differences(name: str, before: dict[str, Any], now: dict[str, Any], bound: float) -> list[str]:
    lines = []
    for key in before.keys() | now.keys():
        one, two = before.get(key), now.get(key)
        if isinstance(one, float) and isinstance(two, float):
            limit = SAME_TIME if key == "end_time" else bound
            if key == "end_time" and now["status"] == "diverged":
                continue  # when it diverges is a matter of rounding, that it does is not
            if abs(one - two) <= limit:
                continue
        elif one == two:
            continue
        lines.append(f"{name}: {key} was {one}, is {two}")
    return lines


def main() -> int:
    now, lines = {}, []
    recorded = json.loads(NUMBERS.read_text()) if NUMBERS.is_file() else {}
    for name, case in cases():
        now[name] = result(case)
        theory = case["model"] in ("modes", "obstacle", "elastica")
        bound = SCATTER.get(name, THEORY if theory else MUJOCO)
        if name in recorded:
            lines += differences(name, recorded[name], now[name], bound)
    if "--record" in sys.argv:
        NUMBERS.write_text(json.dumps(now, indent=1) + "\n")
    print(*lines, f"{len(now)} scenes, {len(lines)} differences", sep="\n")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
