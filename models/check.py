"""Checks that all files of this folder load, and that the strip's and the scripts walk as they say.

Needs mujoco and numpy alone, so that any version of MuJoCo can be asked: python models/check.py
"""

import re
import sys
from pathlib import Path

import mujoco
import numpy as np
import walk_quadruped
import walk_strip
from attach import attach

HERE = Path(__file__).parent
FLOOR = "<mujoco><worldbody><geom type='plane' size='2 2 0.1'/></worldbody></mujoco>"
BY_BOUNDS = {"felt": 0.0328, "polyethylene": -0.0001, "gelatin": -0.0343}  # L, as mjsim has them


def distance(model: mujoco.MjModel) -> float:
    """Displacement over L of a strip in one wave at 2 s per ramp."""
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=100)
    start, dt = data.qpos[0], model.opt.timestep
    stages = walk_strip.PEAK * np.array(walk_strip.WAVE, dtype=float)
    for time in np.arange(1, round(10 / dt) + 1) * dt:
        data.ctrl[:] = [np.interp(time / 2, range(len(stages)), column) for column in stages.T]
        mujoco.mj_step(model, data)
    return float(data.qpos[0] - start) / 0.13


def main() -> int:
    """Check all; returns 1 if something is not as it should be."""
    pairs = []
    for path in sorted(HERE.glob("*.xml")):
        model = mujoco.MjModel.from_xml_path(str(path))
        mujoco.mj_step(model, mujoco.MjData(model), nstep=20)
        if path.stem.partition("_")[0] in BY_BOUNDS:
            told = re.search(r"([+-]\d\.\d{3}) L at 2 s", path.read_text())
            pairs.append((path.name, distance(model), float(told[1]) if told else np.nan))
    scene = mujoco.MjSpec.from_string(FLOOR)
    attach(scene, HERE / "gelatin.xml", prefix="a_")
    pairs.append(("gelatin.xml, attached", distance(scene.compile()), -0.035))
    pairs += [(f"walk_strip {name}", walk_strip.walk(name), x) for name, x in BY_BOUNDS.items()]
    pairs.append(("walk_quadruped gelatin", walk_quadruped.walk("gelatin"), -0.0466))
    off = [pair for pair in pairs if not abs(pair[1] - pair[2]) < 0.002]
    for name, shift, expected in pairs:
        print(f"{name}: {shift:+.4f} L, expected {expected:+.4f}")
    print(f"mujoco {mujoco.__version__}: {len(off)} of {len(pairs)} are off")
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main())
