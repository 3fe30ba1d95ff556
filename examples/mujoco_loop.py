"""MuJoCo alone: a scene of models/, its pressures as controls, no code of mjsim in the loop."""

from pathlib import Path

import mujoco
import numpy as np

from mjsim import GAITS, Robot

MODEL = Path(__file__).resolve().parent.parent / "models" / "gelatin.xml"


def main() -> float:
    model = mujoco.MjModel.from_xml_path(str(MODEL))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("flat").id)
    mujoco.mj_step(model, data, nstep=100)
    start = float(data.sensor("left_position").data[0])
    gait, pressure = GAITS["wave"], Robot().peak_pressure
    for step in range(round(gait.period / model.opt.timestep)):
        time = np.array([(step + 1) * model.opt.timestep])
        data.ctrl[:] = pressure * gait.fractions(time)[0]  # Pa
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    shift = (float(data.sensor("left_position").data[0]) - start) / Robot().length
    print(f"{shift:+.4f} L in a cycle")
    return shift


if __name__ == "__main__":
    main()
