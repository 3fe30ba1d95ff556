"""A robot of limbs walks in MuJoCo: one scene, compiled once and stepped as often as needed."""

import math
import time as clock
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene.chain import joint_springs, link_lengths
from analytic.scene.gait import Gait
from analytic.scene.limbs import outline
from mjsim.friction.in_plane import Grips
from mjsim.model.compiled import Compiled
from mjsim.model.limbs import ROOT, hinge_names, limb_body, tree_spec
from mjsim.results.limb_walk import TreeWalk
from mjsim.results.status import THROWN, Status
from mjsim.scene.limbs import TreeNumerics, TreeScene
from mjsim.simulation.copies import Copied

Array = NDArray[np.float64]

_BARE = Path(__file__).parents[1] / "model" / "bare.xml"
_TIPPED = 1.0  # rad of pitch or roll of the trunk as a whole: it fell over; chosen
_STEEP, _LEANS = math.tan(_TIPPED), math.sin(_TIPPED)
_BLOCK = 256  # steps between reports of progress


class TreeObservation(NamedTuple):
    """What a controller sees after a step.

    Attributes:
        time: since the first cycle began [s].
        pressure: in the limbs, (L,) [Pa].
        place: of the trunk's beginning, (2,) [m].
        heading: of the trunk, to the left [rad].
        contacts: how many limbs touch the ground.
        status: OK, or why the simulation stopped.
    """

    time: float
    pressure: Array
    place: Array
    heading: float
    contacts: int
    status: Status


class TreeSimulation(Copied):
    """One scene; copies walk on as it would.

    Args:
        scene: the walk.
        numerics: how it is discretised.

    Attributes:
        scene, numerics: what is simulated and how.
        model, data: MuJoCo's.

    Raises:
        ValueError: the scene and the numerics do not go together.
    """

    def __init__(self, scene: TreeScene, numerics: TreeNumerics | None = None) -> None:
        self.scene, self.numerics = scene, numerics or TreeNumerics()
        self.numerics.check(scene)
        ground = mujoco.MjSpec.from_file(str(_BARE))
        self.model = tree_spec(scene, self.numerics, ground).compile()
        self.data = mujoco.MjData(self.model)
        joints = [
            self.model.joint(name) for name in hinge_names(scene.robot, self.numerics.elements)
        ]
        self._hinges = np.array([joint.id for joint in joints])
        qpos = [int(joint.qposadr[0]) for joint in joints]
        self._order = np.array([*range(len(ROOT)), *qpos])
        self._rest_angles = np.array(qpos)
        self._length = outline(scene.robot)[0]
        trunk, elements = scene.robot.limbs[0], self.numerics.elements
        self._trunk = (
            self.model.body(limb_body(trunk.name, 0)).id,
            self.model.body(limb_body(trunk.name, elements)).id,
            float(link_lengths(trunk.strip, elements)[-1]),
        )
        self._compiled = Compiled(self.model)
        self.reset()

    def reset(self) -> TreeObservation:
        """Lay the robot on the ground and let it settle."""
        self._compiled.restore(self.model)
        mujoco.mj_resetData(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)
        self._grips = Grips(self.scene, self.numerics, self.model, self.data)
        self._status, self._wall = Status.OK, 0.0
        self._coordinates: list[Array] = []
        self._pressures: list[Array] = []
        self._contacts: list[int] = []
        limbs = len(self.scene.robot.limbs)
        self._settling = max(1, round(self.scene.settle_time / self.numerics.timestep))
        self._play(np.zeros((self._settling, limbs)))
        return self.observe()

    def step(self, pressures: ArrayLike) -> TreeObservation:
        """Do one time step at pressures of the limbs, (L,) [Pa].

        Raises:
            ValueError: they are not of that kind.
        """
        row = np.asarray(pressures, dtype=float)
        if row.shape != (len(self.scene.robot.limbs),) or not np.isfinite(row).all():
            raise ValueError(
                f"pressures must be {len(self.scene.robot.limbs)} finite numbers [Pa], got "
                f"{pressures!r}"
            )
        self._play(row[None])
        return self.observe()

    def run(
        self,
        policy: Gait | Callable[[TreeObservation], ArrayLike] | None = None,
        progress: Callable[[int], None] | None = None,
    ) -> TreeWalk:
        """Walk from rest for the scene's cycles.

        Args:
            policy: commands the pressures; the scene's gait if None.
            progress: called now and then with the number of steps done since the last call.
        """
        policy = self.scene.gait if policy is None else policy
        observation = self.reset()
        steps = round(self.scene.cycles * self.scene.gait.period / self.numerics.timestep)
        if isinstance(policy, Gait):
            time = self.numerics.timestep * np.arange(1.0, steps + 1.0)
            rows = self.scene.robot.peak_pressure * policy.fractions(time)
            for begin in range(0, steps, _BLOCK):
                self._play(rows[begin : begin + _BLOCK])
                if progress:
                    progress(min(_BLOCK, steps - begin))
        else:
            for _ in range(steps):
                if self._status is not Status.OK:
                    break
                observation = self.step(policy(observation))
                if progress:
                    progress(1)
        return self.walk()

    def observe(self) -> TreeObservation:
        """What there is to see now."""
        return TreeObservation(
            time=(len(self._contacts) - self._settling) * self.numerics.timestep,
            pressure=self._pressures[-1].copy(),
            place=self.data.qpos[:2].copy(),
            heading=float(self.data.qpos[3]),
            contacts=self._contacts[-1],
            status=self._status,
        )

    def walk(self) -> TreeWalk:
        """Everything since the last reset."""
        count = len(self._contacts)
        first = 1 - self._settling
        return TreeWalk(
            scene=self.scene,
            numerics=self.numerics,
            status=self._status,
            time=self.numerics.timestep * np.arange(first, first + count, dtype=float),
            pressure=np.array(self._pressures),
            coordinates=np.array(self._coordinates),
            contacts=np.array(self._contacts),
            wall_time=self._wall,
        )

    def _play(self, pressures: Array) -> None:
        scene, model, data, grips = self.scene, self.model, self.data, self._grips
        parts = [
            joint_springs(limb.strip, self.numerics.elements, pressures[:, [i]])
            for i, limb in enumerate(scene.robot.limbs)
        ]
        stiffness, rest = (np.concatenate([part[k] for part in parts], axis=1) for k in (0, 1))
        started = clock.perf_counter()
        for step, row in enumerate(pressures):
            if self._status is not Status.OK:
                break
            model.jnt_stiffness[self._hinges] = stiffness[step]
            model.qpos_spring[self._rest_angles] = rest[step]
            grips.before_step(row)
            mujoco.mj_step(model, data)
            grips.after_step()
            self._coordinates.append(data.qpos[self._order])
            self._pressures.append(row)
            self._contacts.append(len({contact.limb for contact in grips.contacts}))
            self._judge()
        self._wall += clock.perf_counter() - started

    def _judge(self) -> None:
        """Stop where a coordinate is beyond any walk, all is in the air, or the trunk tipped over.

        A long trunk bends by more than that at its beginning, so its ends tell its pitch; its side
        is level on every link alike.
        """
        data, (first, last, length) = self.data, self._trunk
        height = data.qpos.item(2)
        if not (math.isfinite(height) and abs(height) < self._length):
            self._status = Status.DIVERGED
            return
        (x, y, z), (u, v, w) = data.xpos[first].tolist(), data.xpos[last].tolist()
        along = data.xmat[last].tolist()
        ahead = u - x + length * along[0], v - y + length * along[3]
        rise, aside = w - z + length * along[6], along[7]
        tipped = abs(rise) > _STEEP * math.hypot(*ahead) or abs(aside) > _LEANS
        if tipped or self._grips.lowest() > THROWN * self._length:
            self._status = Status.TOPPLED


def simulate(scene: TreeScene, numerics: TreeNumerics | None = None) -> TreeWalk:
    """Walk a scene's gait: `TreeSimulation(scene, numerics).run()`."""
    return TreeSimulation(scene, numerics).run()
