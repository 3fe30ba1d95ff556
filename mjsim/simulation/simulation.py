"""A scene stepped in MuJoCo: the one loop, for gaits, controllers, environments and sweeps."""

import time as clock
from collections.abc import Callable
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.friction.contact_length import may_lie_flat
from analytic.scene.gait import Gait
from mjsim.friction.contact_length import pads_by_node
from mjsim.friction.laws import traction
from mjsim.friction.recorder import ContactRecorder
from mjsim.model.builder import compile_model
from mjsim.model.chambers import Chambers
from mjsim.model.compiled import Compiled
from mjsim.results.judge import judge
from mjsim.results.status import AT_REST, Status
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene, registry
from mjsim.simulation.copies import Copied
from mjsim.simulation.kinematics import ends_may_be, nodes_of, positions
from mjsim.simulation.schedule import before_start, check_steps, walking, walking_steps

Array = NDArray[np.float64]

_MORE_TIMES = 100  # that the last tenth of the settling time is repeated for want of rest; chosen
_BLOCK = 1024  # steps that are prepared at once


class Observation(NamedTuple):
    """What a controller sees after a step.

    Attributes:
        time: since the first cycle began [s].
        pressure: in the chambers, left segment first, (S,) [Pa].
        left, right: x of the two ends [m].
        contact_left, contact_right: length of side contact, 0 for a tip [m].
        status: OK, or why the simulation stopped.
    """

    time: float
    pressure: Array
    left: float
    right: float
    contact_left: float
    contact_right: float
    status: Status


Policy = Callable[[Observation], ArrayLike]
"""From what is seen to what the valves are commanded, (S,) [Pa]; a Gait is the open-loop one."""


class Simulation(Copied):
    """One scene, compiled once and stepped as often as needed; copies walk on as it would.

    Args:
        scene: the walk.
        numerics: how it is discretised; chosen for the scene where not given.
        forces: whether to record what the ground does to each node, at 10 us a step.
        history: whether to keep all states, or the last one only, without forces.

    Attributes:
        scene, numerics: what is simulated and how, with a number for everything.
        model, data: MuJoCo's; the model is as compiled after each reset, whatever was set in it.

    Raises:
        ValueError: the scene and the numerics do not go together.
    """

    def __init__(
        self,
        scene: Scene,
        numerics: Numerics | None = None,
        forces: bool = False,
        history: bool = True,
    ) -> None:
        self.scene, self._with_forces, self._history = scene, forces and history, history
        self.numerics = (numerics or Numerics()).resolved(scene.body, scene.friction)
        check_steps(scene, self.numerics)
        self.model = compile_model(scene, self.numerics)
        self.data = mujoco.MjData(self.model)
        self._compiled = Compiled(self.model)
        self.reset()

    def reset(self, seed: int | None = None) -> Observation:
        """Lay the strip on the ground and let it settle; inflate it to the gait's first stage.

        Args:
            seed: of `rng`, for controllers and environments that draw numbers.
        """
        scene, numerics, model = self.scene, self.numerics, self.model
        self.rng = np.random.default_rng(seed)
        self._compiled.restore(model)
        mujoco.mj_resetData(model, self.data)
        mujoco.mj_forward(model, self.data)
        self._joints = registry.find(scene.body).bind(model, self.data, scene, numerics)
        self._traction = traction(scene, numerics, model, self.data)
        self._pads = pads_by_node(model)
        self._chambers = Chambers(scene.valves, len(scene.robot.segments), numerics.timestep)
        self._pressure = self._chambers.pressure
        self._recorder = ContactRecorder(scene, model, self.data) if self._with_forces else None
        self._coordinates: list[Array] = []
        self._ends: list[tuple[float, float, float, float]] = []
        self._pressures: list[Array] = []
        self._wall = self._cpu = 0.0
        self._stopped, self._dropped = False, 0
        self._unsettled = not self._settle()
        self._first = 1 - len(self._ends) - self._dropped
        return self.observe()

    def _settle(self) -> bool:
        """Do the steps before the first cycle, more if need be; whether the strip is at rest."""
        before = before_start(self.scene, self.numerics)
        late = max(1, round(0.1 * self.scene.settle_time / self.numerics.timestep))
        self._play(before[:-late])
        still = before[-late:]
        for _ in range(_MORE_TIMES):
            ends = self.data.ten_length.copy()
            self._play(still)
            speed = np.abs(self.data.ten_length - ends).max() / (late * self.numerics.timestep)
            if speed < AT_REST * self.scene.robot.length:
                return True
        return False

    def step(self, valves: ArrayLike) -> Observation:
        """Do one time step; see play."""
        return self.play(np.asarray(valves, dtype=float)[None])

    def play(self, valves: ArrayLike) -> Observation:
        """Do a step for each row of commands, (T, S) [Pa], or up to a failure.

        Pressures are of the left segment first, below 0 on the other face.

        Raises:
            ValueError: the commands are not of that kind.
        """
        commands = np.asarray(valves, dtype=float)
        if commands.shape[1:] != self._pressure.shape or not np.isfinite(commands).all():
            raise ValueError(
                f"valves must be {len(self._pressure)} finite pressures [Pa], got {valves!r}"
            )
        if not self._stopped:
            self._play(commands)
        return self.observe()

    def run(
        self, policy: Gait | Policy | None = None, progress: Callable[[int], None] | None = None
    ) -> Trajectory:
        """Walk from rest for the scene's cycles.

        Args:
            policy: commands the valves; the scene's gait if None.
            progress: called now and then with the number of steps done since the last call.

        Returns:
            The trajectory; look at its status before any number of it.
        """
        policy = self.scene.gait if policy is None else policy
        observation = self.reset()
        if progress:
            progress(len(self._ends))
        if isinstance(policy, Gait):
            valves = walking(self.scene, self.numerics, policy)
            for begin in range(0, len(valves), _BLOCK):
                if self._stopped:
                    break
                block = valves[begin : begin + _BLOCK]
                self._play(block)
                if progress:
                    progress(len(block))
        else:
            for _ in range(walking_steps(self.scene, self.numerics)):
                if self._stopped:
                    break
                observation = self.step(policy(observation))
                if progress:
                    progress(1)
        return self.trajectory()

    def observe(self) -> Observation:
        """What there is to see now."""
        kind = self._traction
        left, right = self._x_of_ends()
        return Observation(
            time=(self._first + self._dropped + len(self._ends) - 1) * self.numerics.timestep,
            pressure=self._pressure.copy(),
            left=left,
            right=right,
            contact_left=kind.contact_left,
            contact_right=kind.contact_right,
            status=self._now(),
        )

    def trajectory(self) -> Trajectory:
        """Everything since the last reset, or the last state where no history is kept."""
        count, first = len(self._ends), self._first + self._dropped
        contact_left, contact_right, left_slip, drift = np.array(self._ends).T
        coordinates = np.concatenate(self._coordinates)[:count]
        walk = Trajectory(
            scene=self.scene,
            numerics=self.numerics,
            status=Status.OK,
            time=self.numerics.timestep * np.arange(first, first + count, dtype=float),
            pressure=np.concatenate(self._pressures)[:count],
            coordinates=coordinates,
            position=positions(self.model, self.numerics, coordinates),
            contact_left=contact_left,
            contact_right=contact_right,
            left_slip_fraction=left_slip,
            drift=drift,
            wall_time=self._wall,
            cpu_time=self._cpu,
            forces=self._recorder.forces(count) if self._recorder else None,
        )
        return judge(walk, stopped=self._stopped, unsettled=self._unsettled)

    def _play(self, valves: Array) -> None:
        """Do as many steps as there are commands, (T, S) [Pa], or up to a failure."""
        scene, numerics, model, data = self.scene, self.numerics, self.model, self.data
        pressures = self._chambers.follow(valves)
        joints, law = self._joints, self._traction
        loads = joints.loads(valves, self._pressure, pressures)
        sticky = scene.ground.at(0.0).adhesion > 0  # which may hold an inflated end flat
        flat = (sticky | may_lie_flat(pressures[:, [0, -1]], scene.robot.peak_pressure)).tolist()
        if not len(valves) or self._stopped:
            return
        coordinates = np.empty((len(valves), model.nq))
        ends: list[tuple[float, float, float, float]] = []
        apply, slopes, shift = joints.apply, joints.slopes, joints.shift
        before_step, after_step = law.before_step, law.after_step
        step_model, dt, qpos = mujoco.mj_step, numerics.timestep, data.qpos
        height = data.geom_xpos[:, 2].item
        first, last = int(self._pads[0, 0]), int(self._pads[-1, 0])
        low, high = ends_may_be(scene, numerics)
        record = self._recorder and self._recorder.record

        started, worked = clock.perf_counter(), clock.process_time()
        for step, (load, (left, right_end)) in enumerate(zip(loads, flat, strict=True)):
            apply(load)
            before_step(slopes(), left, right_end)
            step_model(model, data)
            if record:
                record()
            excess = after_step(dt)
            if excess:
                shift(excess)
            coordinates[step] = qpos
            ends.append((law.contact_left, law.contact_right, law.left_slip, law.drift))
            if not (low < height(first) < high and low < height(last) < high):
                self._stopped = True
                break
        self._wall += clock.perf_counter() - started
        self._cpu += clock.process_time() - worked

        self._pressure = pressures[len(ends) - 1]
        self._coordinates.append(coordinates[: len(ends)])
        self._pressures.append(pressures[: len(ends)])
        self._ends += ends
        if not self._history:
            self._dropped += len(self._ends) - 1
            del self._ends[:-1], self._coordinates[:-1], self._pressures[:-1]
            self._coordinates[0] = self._coordinates[0][-1:]
            self._pressures[0] = self._pressures[0][-1:]

    def nodes(self) -> Array:
        """Vertices of the neutral line now, z over flat rest, (N + 2, 3) [m]."""
        mujoco.mj_kinematics(self.model, self.data)
        return nodes_of(self.data, self._pads, self.numerics)

    def _x_of_ends(self) -> tuple[float, float]:
        """Where the ends are after the last step."""
        mujoco.mj_kinematics(self.model, self.data)
        left, right = (float(self.data.geom_xpos[self._pads[i], 0].mean()) for i in (0, -1))
        return left, right

    def _now(self) -> Status:
        if self._stopped:
            return self.trajectory().status
        return Status.UNSETTLED if self._unsettled else Status.OK


def simulate(
    scene: Scene,
    numerics: Numerics | None = None,
    progress: Callable[[int], None] | bool | None = None,
    forces: bool = False,
) -> Trajectory:
    """Walk a scene's gait: `Simulation(scene, numerics, forces).run()`.

    Args:
        scene, numerics, forces: see Simulation.
        progress: called now and then with the number of steps done since the last call; True for a
            bar, in a notebook or a terminal.
    """
    simulation = Simulation(scene, numerics, forces)
    if progress is not True:
        return simulation.run(progress=progress or None)
    from tqdm.auto import tqdm

    total = round(scene.duration / simulation.numerics.timestep)
    with tqdm(total=total, desc=scene.ground.name, unit="step") as bar:
        return simulation.run(progress=lambda steps: (bar.update(steps), None)[1])
