"""The loop of `mjsim.simulation.simulation.Simulation`, for many scenes at once."""

from collections.abc import Sequence

import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from analytic.friction.contact_length import flat_pressures
from analytic.scene.actuator import Memory
from analytic.scene.chain import joint_springs
from analytic.scene.limbs import memory
from mjsim.friction.footing import feet_may_be, thrown
from mjsim.model.chambers import ChamberPressures
from mjsim.model.pads import pads_by_node
from mjsim.model.pneumatics import controls
from mjsim.results.status import AT_REST
from mjsim.scene import Resolved, Scene
from mjsim.simulation.schedule import before_start, check_steps
from mjsim.simulation.side_by_side.between import BATCH_LAWS
from mjsim.simulation.side_by_side.ends import Indices
from mjsim.simulation.side_by_side.layout import layout, models, refusal, write

Array = NDArray[np.float64]

_FIRST_HINGE = 3  # the joints are x, z, pitch, then the hinges


class Block:
    """Steps that `StripBatch.play` did, one row per scene and one column per step.

    Attributes:
        rows: the scenes.
        pressure: in the chambers, (R, T, S) [Pa].
        coordinates: of MuJoCo after each step, (R, T, nq).
        contact: lengths of side contact, (R, T, 2) [m].
        left_slip: part of a change of separation that is the left end's, (R, T).
        drift: speed of what friction should have anchored, (R, T) [m/s].
        steps: that were done before a scene stopped, (R,).
    """

    def __init__(self, rows: Indices, pressure: Array, nq: int) -> None:
        shape = pressure.shape[:2]
        self.rows, self.pressure = rows, pressure
        self.coordinates = np.empty((*shape, nq))
        self.contact = np.empty((*shape, 2))
        self.left_slip, self.drift = np.empty(shape), np.empty(shape)
        self.steps = np.full(shape[0], shape[1])


class StripBatch:
    """Scenes of one layout, stepped together.

    Args:
        scenes: see mjsim.simulation.side_by_side.layout.refusal and layout.
        numerics: of all of them, with a number for everything.
        threads: of MuJoCo.

    Attributes:
        scenes, numerics: what is simulated.
        pressure: in the chambers now, (B, S) [Pa].
        stopped: scenes that failed, (B,).

    Raises:
        ValueError: a scene cannot be stepped so, or they are not of one layout.
    """

    def __init__(self, scenes: Sequence[Scene], numerics: Resolved, threads: int = 1) -> None:
        self.scenes, self.numerics = list(scenes), numerics
        for scene in scenes:
            self._check(scene)
            check_steps(scene, numerics)
        if len({layout(scene, numerics) for scene in scenes}) > 1:
            raise ValueError("scenes that are stepped side by side must be of one layout")
        given = models(scenes, numerics)
        self.model = given[0]
        self._batch = batch = Batch(self.model, len(scenes), threads)
        every = np.arange(len(scenes))
        write(batch, every.tolist(), given)
        self._stiffness, self._rest = batch.expand("jnt_stiffness"), batch.expand("qpos_spring")
        self._qpos, self._place = batch.bind("qpos"), batch.bind("geom_xpos")
        self._length, self._control = batch.bind("ten_length"), batch.bind("ctrl")
        pads = pads_by_node(self.model)[:, 0]
        self._feet = pads[[0, -1]]
        law = BATCH_LAWS[scenes[0].friction, scenes[0].between]
        self._ends = law(scenes, numerics, batch, self.model)
        self._nodes, self._limits = pads, np.array([_limits(s, numerics) for s in scenes])
        self.pressure = np.zeros((len(scenes), len(scenes[0].strip.segments)))
        self.stopped = np.zeros(len(scenes), dtype=bool)
        self._chambers: list[ChamberPressures] = [self._at_rest(scene) for scene in scenes]
        self._memories: list[Memory] = [memory(scene.strip) for scene in scenes]
        self._lay(every)

    def _check(self, scene: Scene) -> None:
        reason = refusal(scene, self.numerics)
        if reason:
            raise ValueError(f"to be stepped side by side, {reason}")

    def __getstate__(self) -> None:
        raise TypeError("strips that are stepped side by side cannot be copied, single ones can")

    def _at_rest(self, scene: Scene) -> ChamberPressures:
        return ChamberPressures(scene.valves, len(scene.strip.segments), self.numerics.timestep)

    def _lay(self, rows: Indices) -> None:
        """Lay strips on the ground, without pressure."""
        for row in rows.tolist():
            self._chambers[row] = self._at_rest(self.scenes[row])
            self._memories[row] = memory(self.scenes[row].strip)
        self.pressure[rows], self.stopped[rows] = 0.0, False
        none = np.zeros((len(rows), 1, self.pressure.shape[1]))
        self._apply(rows, self._loads(rows, none, none, none)[0])
        self._batch.reset(rows)
        self._ends.start(rows)

    def reset(self, rows: Indices, scenes: Sequence[Scene] | None = None) -> list[Block]:
        """Lay strips on the ground, let them settle and inflate them to the gait's first stage.

        Args:
            rows: which, (R,).
            scenes: in place of theirs, of the same layout.

        Returns:
            The steps that were done; `settled` tells which are at rest.
        """
        if scenes is not None:
            for row, scene in zip(rows.tolist(), scenes, strict=True):
                self._check(scene)
                self.scenes[row] = scene
            write(self._batch, rows.tolist(), models(scenes, self.numerics))
            self._ends.replace(rows, scenes)
            self._limits[rows] = [_limits(scene, self.numerics) for scene in scenes]
        self._lay(rows)
        valves = np.array([before_start(self.scenes[row], self.numerics) for row in rows])
        late = max(1, round(0.1 * self.scenes[0].settle_time / self.numerics.timestep))
        begin = self.play(valves[:, :-late], rows)
        ends = self._length[rows].copy()
        end = self.play(valves[:, -late:], rows)
        speed = np.abs(self._length[rows] - ends).max(axis=1) / (late * self.numerics.timestep)
        lengths = np.array([self.scenes[row].strip.length for row in rows])
        self.settled = speed < AT_REST * lengths
        return [begin, end]

    def play(self, valves: Array, rows: Indices | None = None) -> Block:
        """Do as many steps as there are commands, (R, T, S) [Pa], or up to a failure of each."""
        rows = np.arange(len(self.scenes)) if rows is None else rows
        pressure = np.array(
            [self._chambers[row].follow(v) for row, v in zip(rows.tolist(), valves, strict=True)]
        )
        block = Block(rows, pressure, self.model.nq)
        if not valves.shape[1]:
            return block
        acting = np.array([
            self._memories[row].follow(path)
            for row, path in zip(rows.tolist(), pressure, strict=True)
        ])  # fmt: skip
        loads = self._loads(rows, valves, pressure, acting)
        may = np.array([flat_pressures(self.scenes[row].strip)[[0, -1]] for row in rows])
        flat = np.abs(acting[:, :, [0, -1]]) <= may[:, None]
        dt, ends = self.numerics.timestep, self._ends
        active = np.flatnonzero(~self.stopped[rows])
        block.steps[self.stopped[rows]] = 0
        for step, load in enumerate(loads):
            moving = rows[active]
            if not len(moving):
                break
            self._apply(moving, [part[active] for part in load])
            angles = self._qpos[moving, _FIRST_HINGE - 1 :]
            slopes = np.stack([angles[:, 0], -angles.sum(axis=1)], axis=1)
            ends.before_step(moving, slopes, flat[active, step])
            self._batch.step(moving)
            self._qpos[moving, 0] -= ends.after_step(moving, dt)
            block.coordinates[active, step] = self._qpos[moving]
            block.contact[active, step] = ends.contact[moving]
            block.left_slip[active, step] = ends.left_slip[moving]
            block.drift[active, step] = ends.drift[moving]
            low, high, thrown_from = self._limits[moving].T
            height = self._place[moving[:, None], self._feet, 2]
            stands = ((low[:, None] < height) & (height < high[:, None])).all(axis=1)
            lowest = self._place[moving[:, None], self._nodes, 2].min(axis=1)
            fallen = ~(stands & (lowest < thrown_from))
            if fallen.any():
                block.steps[active[fallen]] = step + 1
                self.stopped[moving[fallen]] = True
                active = active[~fallen]
        self.pressure[rows] = pressure[np.arange(len(rows)), np.maximum(block.steps, 1) - 1]
        return block

    def coordinates(self, rows: Indices) -> Array:
        """Coordinates of MuJoCo, (R, nq)."""
        return np.array(self._qpos[rows])

    def _loads(
        self, rows: Indices, valves: Array, pressure: Array, acting: Array
    ) -> list[tuple[Array, ...]]:
        """Effects of pressure at each step: stiffness and rest angles of the hinges, or controls.

        Args:
            rows: which, (R,).
            valves, pressure: commands of the valves and pressures in the chambers, (R, T, S) [Pa].
            acting: pressures that bend, see analytic.scene.actuator.Memory, (R, T, S) [Pa].
        """
        each: list[tuple[Array, ...]] = []
        for row, command, inside, bends in zip(
            rows.tolist(), valves, pressure, acting, strict=True
        ):
            scene, numerics = self.scenes[row], self.numerics
            if scene.actuation == "actuators":
                each.append((controls(scene, numerics, command, self.pressure[row], inside),))
            else:
                each.append(joint_springs(scene.strip, numerics.links, bends, scene.chamber))
        return list(zip(*(np.array(part).swapaxes(0, 1) for part in zip(*each, strict=True)),
                        strict=True))  # fmt: skip

    def _apply(self, rows: Indices, load: Sequence[Array]) -> None:
        """Set springs or controls for the next step, (R, N) each."""
        if len(load) == 1:
            (self._control[rows],) = load
        else:
            self._stiffness[rows, _FIRST_HINGE:], self._rest[rows, _FIRST_HINGE:] = load


def _limits(scene: Scene, numerics: Resolved) -> tuple[float, float, float]:
    """Heights between which the ends' pads stand, and from which on the lowest is thrown [m]."""
    return *feet_may_be(scene, numerics), thrown(scene, numerics)
