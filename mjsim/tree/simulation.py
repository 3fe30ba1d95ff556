"""A robot of limbs walks in MuJoCo."""

import time as clock
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.chain import joint_springs
from mjsim.bodies.parts import PREFIX
from mjsim.simulation.status import Status
from mjsim.tree.body import ROOT, tree_spec
from mjsim.tree.friction import Grips
from mjsim.tree.scene import TreeNumerics, TreeScene

Array = NDArray[np.float64]


@dataclass(frozen=True, repr=False)
class TreeWalk:
    """One simulated walk, a row per time step, settling included."""

    scene: TreeScene
    numerics: TreeNumerics
    status: Status
    time: Array
    pressure: Array
    coordinates: Array
    wall_time: float

    @property
    def start(self) -> int:
        return int(np.searchsorted(self.time, 0.0, side="right")) - 1

    @property
    def displacement(self) -> Array:
        return self.coordinates[-1, :2] - self.coordinates[self.start, :2]

    @property
    def turn(self) -> float:
        return float(self.coordinates[-1, 3] - self.coordinates[self.start, 3])


class TreeSimulation:
    def __init__(self, scene: TreeScene, numerics: TreeNumerics | None = None) -> None:
        self.scene, self.numerics = scene, numerics or TreeNumerics()
        from pathlib import Path

        bare = Path(__file__).parent.parent / "ground" / "bare.xml"
        spec = tree_spec(scene, self.numerics, mujoco.MjSpec.from_file(str(bare)))
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)

    def run(self) -> TreeWalk:
        scene, numerics, model, data = self.scene, self.numerics, self.model, self.data
        mujoco.mj_resetData(model, data)
        mujoco.mj_forward(model, data)
        grips = Grips(scene, numerics, model, data)
        dt = numerics.timestep
        first = -round(scene.settle_time / dt)
        steps = round(scene.cycles * scene.gait.period / dt)
        times = dt * np.arange(first + 1, steps + 1)
        pressures = scene.robot.peak_pressure * scene.gait.fractions(times)
        parts = [
            joint_springs(limb.strip, numerics.elements, pressures[:, [i]])
            for i, limb in enumerate(scene.robot.limbs)
        ]
        stiffness = np.concatenate([p[0] for p in parts], axis=1)
        rest = np.concatenate([p[1] for p in parts], axis=1)
        names = [
            f"{PREFIX}{l}_hinge_{i}"
            for l in scene.robot.names
            for i in range(1, numerics.elements + 1)
        ]
        joints = np.array([model.joint(n).id for n in names])
        qpos = np.array([model.joint(n).qposadr[0] for n in names])
        coordinates = np.empty((len(times), len(ROOT) + len(names)))
        order = np.concatenate([np.arange(len(ROOT)), qpos])
        # mirrored rest angles etc.
        started = clock.perf_counter()
        for step in range(len(times)):
            model.jnt_stiffness[joints] = (
                stiffness[step][:, None] if model.jnt_stiffness.ndim > 1 else stiffness[step]
            )
            model.qpos_spring[qpos] = rest[step]
            grips.before_step(pressures[step])
            mujoco.mj_step(model, data)
            grips.after_step()
            coordinates[step] = data.qpos[order]
        wall = clock.perf_counter() - started
        return TreeWalk(scene, numerics, Status.OK, times, pressures, coordinates, wall)
