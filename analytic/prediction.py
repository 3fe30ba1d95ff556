"""Displacement of a robot in a cycle, by any solver, with the changes of anchor resolved."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.checks import one_of, times_of, whole
from analytic.friction.laws import Friction
from analytic.gradient.inputs import Derivative, Inputs
from analytic.locomotion import WEAK, Locomotion, displacements, left_end
from analytic.scene.gait import Gait
from analytic.scene.ground import depends_on_speed
from analytic.scene.limbs import acting_pressures
from analytic.scene.robot import Robot
from analytic.scene.surface import Ground, Surface
from analytic.shapes import ContactShapes, Flag, Shapes
from analytic.solvers.models import REFERENCE, SOLVERS, Solver

Array = NDArray[np.float64]

_LOCATED = 1e-7  # change of separation over L within which a change of anchor is located; chosen
_PARTS, _ROUNDS = 8, 8  # into which an increment is divided, and how often at most


class Prediction(NamedTuple):
    """One cycle, or several, by one solver.

    Attributes:
        pressures: that act along the path, shape (B, S) [Pa], denser where the anchor changes;
            the chambers' own but of actuators with hysteresis.
        times: of those states, shape (B,) [s]; places along the path in rows where it has no times.
        shapes: their equilibria.
        locomotion: displacements along them.
        flags: every flag that a state carries.
        by_cycle: displacement of the left end in each cycle, shape (C,) [m]. On uniform ground the
            last one is locomotion.per_cycle; the first may differ where a gait starts inflated or
            chambers lag. On ground that changes along x per_cycle is their mean.
        gradient: derivatives of the last cycle's displacement, by the names that were asked for.
    """

    pressures: Array
    times: Array
    shapes: Shapes
    locomotion: Locomotion
    flags: Flag
    by_cycle: Array
    gradient: Mapping[str, Derivative] = MappingProxyType({})

    @property
    def cycles(self) -> int:
        """Number of cycles of the states."""
        return len(self.by_cycle)


def predict(
    robot: Robot,
    gait: Gait,
    ground: Ground,
    solver: Solver | str = REFERENCE,
    states_per_ramp: int = 25,
    friction: Friction = WEAK,
    path: ArrayLike | None = None,
    cycles: int = 1,
    times: ArrayLike | None = None,
    gradient: Sequence[str] = (),
) -> Prediction:
    """Walk quasi-statically, one cycle or along a path.

    The anchor rule is right but for the increments in which the anchor changes. States are added
    there until such an increment changes the separation by 1e-7 of the length; where friction bends
    the strip the solver does so, see analytic.solvers.elastica.

    Args:
        robot, gait, ground: the scene.
        solver: a name of SOLVERS, or a solver with its options.
        states_per_ramp: states in a ramp from no pressure to the peak; fewer in one that changes
            less, but where the ground resists by speed.
        friction: law, tension and slope; "coulomb" needs a solver that knows forces, and elastica
            alone lets friction bend the strip.
        path: pressures to follow instead of the gait's, (B, S) [Pa].
        cycles: number of cycles in the path, of equal duration or of equally many rows.
        times: of the path's states, (B,) [s]; the gait's if there is no path.
        gradient: fields to differentiate the distance by, as in robot.length, surface.tip_force,
            gait.stages or friction.tension, see analytic.gradient.

    Raises:
        ValueError: there is no such solver, law or field, the solver does not know what it needs
            for them, the gait is divided into no states, or the ground resists by speed and
            friction bends nothing or the path has no times.
    """
    if not isinstance(robot, Robot):
        raise ValueError(
            f"predict is for strips, a Robot; of limbs take analytic.solvers.limbs.walk; got "
            f"{type(robot).__name__}"
        )
    if isinstance(solver, str):
        one_of("solver", solver, SOLVERS)
        solver = SOLVERS[solver]()
    whole("states per ramp", states_per_ramp, 1)
    whole("cycles", cycles, 1)
    by_gait = path is None
    if path is None:
        if depends_on_speed(ground):  # which may creep while a pressure is constant
            fractions = gait.pressures(states_per_ramp, cycles)
            times = gait.times(states_per_ramp, cycles)
        else:
            fractions, times = gait.path(states_per_ramp, cycles)
        path = robot.peak_pressure * fractions
    path = acting_pressures(robot, np.asarray(path, dtype=float))
    if times is not None:
        times_of(times, len(path))
    clock = np.asarray(np.arange(len(path)) if times is None else times, dtype=float)
    if depends_on_speed(ground) and (not friction.tension or times is None):
        raise ValueError(
            f"ground {ground.name!r} resists by speed: friction must have a tension above 0, and a "
            "path its times"
        )
    walk = _Walk(robot, solver, friction, cycles, timed=times is not None)
    walked = walk.on([ground], path, clock)[0]
    if not gradient:
        return walked
    if not by_gait:
        raise ValueError("gradient must be of a gait, not of a path that is given")
    from analytic.gradient.gradient import gradient as differentiate

    inputs = Inputs(robot, gait, cast(Surface, ground), friction)  # others are told apart
    return walked._replace(
        gradient=differentiate(
            inputs, solver, walked.shapes, walked.locomotion.left, walked.times, cycles, gradient
        )
    )


def predict_grounds(
    robot: Robot,
    gait: Gait,
    grounds: Sequence[Surface],
    solver: Solver,
    states_per_ramp: int,
    friction: Friction = WEAK,
) -> list[Prediction]:
    """Walk on several grounds, whose friction bends nothing, with shapes that are solved for once.

    Args:
        robot, gait, solver, states_per_ramp: see predict.
        grounds: uniform ones, which neither stick nor resist by speed.
        friction: law, slope and contacts; its tension is taken as 0.

    Raises:
        ValueError: see predict.
    """
    friction = replace(friction, tension=0.0)
    path = acting_pressures(robot, robot.peak_pressure * gait.path(states_per_ramp)[0])
    walk = _Walk(robot, solver, friction, cycles=1, timed=False)
    return walk.on(grounds, path, np.arange(float(len(path))))


class _Walk(NamedTuple):
    """Options of a walk, see predict; `timed` if its states have times that matter."""

    robot: Robot
    solver: Solver
    friction: Friction
    cycles: int
    timed: bool

    def on(self, grounds: Sequence[Ground], path: Array, clock: Array) -> list[Prediction]:
        """Predictions on grounds that shapes are alike on, at pressures (B, S) and times (B,)."""
        times = clock if self.timed else None
        shapes = self.solver.solve(self.robot, path, grounds[0], self.friction, times)
        if isinstance(shapes, ContactShapes) and shapes.rows is not None:
            path, clock = shapes.pressures, np.interp(shapes.rows, np.arange(len(clock)), clock)
        if not self.friction.tension:
            shapes, path, clock = self._located(grounds, shapes, path, clock)
        flags = Flag(int(np.bitwise_or.reduce(shapes.status)))
        ends = np.linspace(clock[0], clock[-1], self.cycles + 1)
        predictions = []
        for ground in grounds:
            locomotion = displacements(shapes, ground, self.cycles, self.friction)
            by_cycle = np.diff(np.interp(ends, clock, locomotion.left))
            if isinstance(ground, Surface):
                locomotion = locomotion._replace(per_cycle=float(by_cycle[-1]))
            predictions.append(Prediction(path, clock, shapes, locomotion, flags, by_cycle))
        return predictions

    def _located(
        self, grounds: Sequence[Ground], shapes: Shapes, path: Array, clock: Array
    ) -> tuple[Shapes, Array, Array]:
        """Shapes, path and times with states added where the anchor changes on any ground.

        An increment is divided until it changes the separation by next to nothing. States without
        a solution count, but where they are so few that its first parts do not meet them.
        """
        for number in range(_ROUNDS):
            moved = np.abs(np.diff(shapes.separation)) > _LOCATED * self.robot.length
            moved |= number == 0  # there and back is no change
            anchors = [left_end(shapes, ground, self.friction)[1] for ground in grounds]
            changes = np.flatnonzero(np.any(anchors, axis=0) & moved)
            if not len(changes):
                break
            part = np.tile(np.arange(1, _PARTS) / _PARTS, len(changes))
            rows = np.repeat(changes, _PARTS - 1)
            more = path[rows] + part[:, None] * (path[rows + 1] - path[rows])
            between = self.solver.solve(self.robot, more, grounds[0], self.friction, None)
            later = clock[rows] + part * (clock[rows + 1] - clock[rows])
            places = np.concatenate([np.arange(len(path)), rows + part])
            solved = np.isfinite(np.append(shapes.separation, between.separation)) | (number == 0)
            solved[: len(path)] = True
            order = np.argsort(places, kind="stable")
            order = order[solved[order]]
            shapes = shapes.with_states(between, order)
            path = np.concatenate([path, more])[order]
            clock = np.concatenate([clock, later])[order]
        return shapes, path, clock
