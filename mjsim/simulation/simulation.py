"""Scenes stepped in MuJoCo: the loop of gaits, controllers, environments and sweeps."""

import math
import time as clock
from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene.gait import Gait
from analytic.scene.limbs import memory
from mjsim.friction.footing import footing
from mjsim.friction.in_plane import LimbFooting
from mjsim.friction.recorder import ContactRecorder
from mjsim.model.bodies.limbs import Hinges
from mjsim.model.builder import compile_model
from mjsim.model.chambers import ChamberPressures
from mjsim.model.compiled import Compiled
from mjsim.model.pads import pads_of
from mjsim.results.judge import judge
from mjsim.results.status import AT_REST, Status
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene, registry, resolved
from mjsim.simulation.copies import Copied
from mjsim.simulation.curved_paths import curved_paths
from mjsim.simulation.kinematics import nodes_of, positions
from mjsim.simulation.observation import Observation, Policy
from mjsim.simulation.schedule import before_start, check_steps, walking, walking_steps

Array = NDArray[np.float64]

_MORE_TIMES = 100  # that the last tenth of the settling time is repeated for want of rest; chosen
_YAW = 3  # of the coordinates of a robot in space
_BLOCK = 1024  # steps that are prepared at once


class Simulation(Copied):
    """One scene, compiled once and stepped as often as needed; copies walk on as it would.

    Args:
        scene: the walk.
        numerics: how it is discretised; chosen for the scene where not given.
        forces: whether to record the forces of the ground on each node, at 10 us a step.
        history: whether to keep all states, or the last one only, without forces.

    Attributes:
        scene, numerics: as simulated, with a number for everything.
        model, data: MuJoCo's; the model is as compiled after each reset, whatever was set in it.
        unconverged: time steps of the last play in which MuJoCo's solver reached its limit.

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
        if forces and scene.in_space:
            raise ValueError("forces on nodes are recorded of strips alone, got a robot of limbs")
        self.scene, self._with_forces, self._history = scene, forces and history, history
        self.numerics = resolved(scene, numerics)
        check_steps(scene, self.numerics)
        self.model = compile_model(scene, self.numerics)
        self.data = mujoco.MjData(self.model)
        self._compiled = Compiled(self.model)
        self.reset()

    def reset(self, seed: int | None = None) -> Observation:
        """Lay the robot on the ground and let it settle; inflate it to the gait's first stage.

        Args:
            seed: of `rng`, for controllers and environments that draw numbers.
        """
        scene, numerics, model = self.scene, self.numerics, self.model
        self.rng = np.random.default_rng(seed)
        self._compiled.restore(model)
        mujoco.mj_resetData(model, self.data)
        mujoco.mj_forward(model, self.data)
        self._joints = (
            Hinges(model, scene, numerics) if scene.in_space
            else registry.find(scene.body).bind(model, self.data, scene, numerics)
        )  # fmt: skip
        self._footing = footing(scene, numerics, model, self.data, self._joints)
        self._pads = pads_of(model, scene)
        self._curved = curved_paths(scene, numerics, model, self.data)
        self._chambers = ChamberPressures(
            scene.valves, len(scene.robot.chambers), numerics.timestep
        )
        self._pressure = self._chambers.pressure
        self._memory = memory(scene.robot)
        self._recorder = ContactRecorder(scene, model, self.data) if self._with_forces else None
        self._coordinates: list[Array] = []
        self._rows: list[tuple[float, ...]] = []
        self._pressures: list[Array] = []
        self._wall = self._cpu = 0.0
        self._stopped, self._dropped, self.unconverged = False, 0, 0
        self._unsettled = not self._settle()
        self._first = 1 - len(self._rows) - self._dropped
        return self.observe()

    def _settle(self) -> bool:
        """Do the steps before the first cycle, more if needed; tell whether it is at rest."""
        before = before_start(self.scene, self.numerics)
        late = max(1, round(0.1 * self.scene.settle_time / self.numerics.timestep))
        self._play(before[:-late])
        still = before[-late:]
        for _ in range(_MORE_TIMES):
            before_late = self._footing.places()
            self._play(still)
            moved = np.abs(self._footing.places() - before_late).max()
            speed = moved / (late * self.numerics.timestep)
            if speed < AT_REST * self.scene.robot.length:
                return True
        return False

    def step(self, valves: ArrayLike) -> Observation:
        """Do one time step; see play."""
        return self.play(np.asarray(valves, dtype=float)[None])

    def play(self, valves: ArrayLike) -> Observation:
        """Do a step for each row of commands, (T, S) [Pa], or up to a failure.

        Pressures are in the order of the gait's columns, below 0 on the other face.

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
            progress: called regularly with the number of steps done since the last call.

        Returns:
            The trajectory; look at its status before any number of it.
        """
        policy = self.scene.gait if policy is None else policy
        observation = self.reset()
        if progress:
            progress(len(self._rows))
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
        """Observation of the state."""
        trunk = self.nodes()[0]
        measured = dict(zip(self._footing.columns, self._rows[-1], strict=True))
        nan, qpos = float("nan"), self.data.qpos
        along, aside, _ = trunk[-1] - trunk[0]
        heading = qpos.item(_YAW) if self.scene.in_space else math.atan2(aside, along)
        return Observation(
            time=(self._first + self._dropped + len(self._rows) - 1) * self.numerics.timestep,
            pressure=self._pressure.copy(),
            place=trunk[0, :2].copy(),
            heading=heading,
            right=float(trunk[-1, 0]),
            contact_left=measured.get("contact_left", nan),
            contact_right=measured.get("contact_right", nan),
            contacts=measured.get("contacts", nan),
            status=self._status(),
        )

    def trajectory(self) -> Trajectory:
        """Everything since the last reset, or the last state where no history is kept."""
        count, first = len(self._rows), self._first + self._dropped
        coordinates = np.concatenate(self._coordinates)[:count]
        walk = Trajectory(
            scene=self.scene,
            numerics=self.numerics,
            status=Status.OK,
            time=self.numerics.timestep * np.arange(first, first + count, dtype=float),
            pressure=np.concatenate(self._pressures)[:count],
            coordinates=coordinates,
            position=positions(self.model, self.scene, self.numerics, coordinates),
            wall_time=self._wall,
            cpu_time=self._cpu,
            forces=self._recorder.forces(count) if self._recorder else None,
            **dict(zip(self._footing.columns, np.array(self._rows).T, strict=True)),
        )
        return judge(walk, stopped=self._stopped, unsettled=self._unsettled)

    def _play(self, valves: Array) -> None:
        """Do as many steps as there are commands, (T, S) [Pa], or up to a failure."""
        model, data, ground = self.model, self.data, self._footing
        pressures = self._chambers.follow(valves)
        if not len(valves) or self._stopped:
            return
        acting = self._memory.follow(pressures)
        loads = self._joints.loads(valves, self._pressure, acting)
        prepared = ground.prepare(acting)
        coordinates = np.empty((len(valves), model.nq))
        rows: list[tuple[float, ...]] = []
        apply, before_step, after_step = self._joints.apply, ground.before_step, ground.after_step
        step_model = self._curved.step if self._curved else mujoco.mj_step
        stands, qpos = ground.stands, data.qpos
        record = self._recorder and self._recorder.record
        iterations, most, self.unconverged = data.solver_niter, model.opt.iterations, 0

        started, worked = clock.perf_counter(), clock.process_time()
        for step, (load, contact) in enumerate(zip(loads, prepared, strict=True)):
            apply(load)
            before_step(contact)
            step_model(model, data)
            if record:
                record()
            if iterations.item(0) >= most:
                self.unconverged += 1
            rows.append(after_step())
            coordinates[step] = qpos
            if not stands():
                self._stopped = True
                break
        self._wall += clock.perf_counter() - started
        self._cpu += clock.process_time() - worked

        self._pressure = pressures[len(rows) - 1]
        self._coordinates.append(coordinates[: len(rows)])
        self._pressures.append(pressures[: len(rows)])
        self._rows += rows
        if not self._history:
            self._dropped += len(self._rows) - 1
            del self._rows[:-1], self._coordinates[:-1], self._pressures[:-1]
            self._coordinates[0] = self._coordinates[0][-1:]
            self._pressures[0] = self._pressures[0][-1:]

    def nodes(self) -> Array:
        """Vertices of the limbs' neutral lines, z over flat rest, (L, N + 2, 3) [m]."""
        data = self.data
        if self.scene.in_space:  # whose friction needs the kinematics from before the step
            data = mujoco.MjData(self.model)
            data.qpos[:] = self.data.qpos
        mujoco.mj_kinematics(self.model, data)
        return nodes_of(self.model, data, self._pads, self.scene, self.numerics)

    def hinges(self) -> Array:
        """Angles of the hinges of each limb of a robot in space, up is positive, (L, N) [rad]."""
        assert isinstance(self._joints, Hinges)
        return self.data.qpos[self._joints.angles].reshape(-1, self.numerics.links)

    def side_contacts(self) -> Array:
        """Length over which each limb of a robot in space lies on its side, (L,) [m]."""
        assert isinstance(self._footing, LimbFooting)
        return self._footing.side_contacts()

    def _status(self) -> Status:
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
        progress: called regularly with the number of steps done since the last call; True for a
            bar, in a notebook or a terminal.
    """
    simulation = Simulation(scene, numerics, forces)
    if progress is not True:
        return simulation.run(progress=progress or None)
    from tqdm.auto import tqdm

    total = round(scene.duration / simulation.numerics.timestep)
    with tqdm(total=total, desc=scene.ground.name, unit="step") as bar:
        return simulation.run(progress=lambda steps: (bar.update(steps), None)[1])
