"""Predictions of measurements: walks in MuJoCo, or quasi-static ones."""

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from analytic.prediction import predict
from analytic.scene import pneunet
from analytic.scene.chain import node_positions
from analytic.scene.limbs import limbs_of
from analytic.solvers.limbs.path import Path
from analytic.solvers.models import Elastica
from mjsim.files import plugins
from mjsim.files.processes import Pool
from mjsim.files.scene_tables.tables import Tables, build
from mjsim.fitting.derivatives import distance_slopes
from mjsim.fitting.observations import RUN, Run, Series
from mjsim.fitting.parameters import robot_of, with_values
from mjsim.results.measures import measure
from mjsim.results.prediction import clears, reference
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate

Array = NDArray[np.float64]

_STATES = 100  # of the quasi-static model in a ramp from no pressure to the peak
_COARSE = {"ends": (4, 0.02), "all": (8, 0.01)}  # links per segment and time step [s]
_COARSE_LIMBS = 4, 0.02  # links of a limb and time step [s]
_MANY = 24  # walks from which on processes gain more than their start takes; chosen


class Motion(NamedTuple):
    """Motion of the strip, or of the trunk, in a run.

    Attributes:
        time: of the states since the first cycle began, (T,) [s].
        x, z: of points at `places`, (T, P) [m].
        places: over the length of the strip or the trunk, (P,).
        displacement, height: ahead per cycle, and the greatest height [m].
        turn: to the left in the last cycle [rad].
        period: of a cycle [s].
    """

    time: Array
    x: Array
    z: Array
    places: tuple[float, ...]
    displacement: float
    height: float
    turn: float
    period: float


Walk = Callable[[Scene, Numerics, tuple[float, ...]], Motion | None]
"""Function from a scene, and places over the length, to the motion; None if the walk failed."""


def by_mujoco(scene: Scene, numerics: Numerics, places: tuple[float, ...]) -> Motion | None:
    """Motion of a scene in MuJoCo."""
    walk = simulate(scene, numerics)
    numbers = measure(walk)
    if numbers is None:
        return None
    length, rows = scene.robot.length, slice(walk.start, None)
    x, z = (part[rows] for part in walk.nodes())
    return Motion(
        walk.time[rows], *_at_places(scene, walk.numerics.links, x, z, places), places,
        numbers.displacement * length, numbers.amplitude * length, numbers.turn, scene.gait.period,
    )  # fmt: skip


def _at_places(
    scene: Scene, links: int, x: Array, z: Array, places: tuple[float, ...]
) -> tuple[Array, Array]:
    """Points of the strip or the trunk through its vertices (T, N + 2), (T, P) each [m]."""
    trunk = limbs_of(scene.robot)[0].strip
    nodes, at = node_positions(trunk, links), np.array(places) * trunk.length
    return CubicSpline(nodes, x, axis=1)(at), CubicSpline(nodes, z, axis=1)(at)


def quasi_static(scene: Scene, numerics: Numerics, places: tuple[float, ...]) -> Motion | None:
    """Motion of a scene by the reference that friction bends, with ideal valves."""
    if scene.in_space:
        return _quasi_static_limbs(scene, numerics, places)
    fractions, times = scene.gait.path(_STATES, scene.cycles)
    walk = predict(
        scene.strip, scene.gait, scene.ground, Elastica(60, scene.chamber),
        friction=scene.reference_friction, cycles=scene.cycles,
        path=scene.robot.peak_pressure * fractions, times=times,
    )  # fmt: skip
    height = float(walk.shapes.amplitude.max())
    if not (math.isfinite(walk.locomotion.per_cycle) and clears(scene, height)):
        return None
    x, z = walk.shapes.curve(np.array(places) * scene.robot.length)
    return Motion(
        walk.times, walk.locomotion.left[:, None] + x, z, places,
        float(walk.by_cycle[-1]), height, 0.0, scene.gait.period,
    )  # fmt: skip


def _quasi_static_limbs(
    scene: Scene, numerics: Numerics, places: tuple[float, ...]
) -> Motion | None:
    theory, links = reference(scene, numerics), resolved(scene, numerics).links
    assert isinstance(theory.walk, Path)
    if not clears(scene, theory.height):
        return None
    nodes = np.array([rest.nodes for rest in theory.walk.rests])
    half = nodes.shape[1] // 2
    trunk = 0.5 * (nodes[:, : links + 2] + nodes[:, half : half + links + 2])
    return Motion(
        theory.walk.times, *_at_places(scene, links, trunk[..., 0], trunk[..., 2], places), places,
        float(theory.displacement[0]) * scene.robot.length, theory.height, theory.turn,
        scene.gait.period,
    )  # fmt: skip


WALKS: dict[str, Walk] = {"mujoco": by_mujoco, "quasi-static": quasi_static}


def coarse(scene: Scene, numerics: Numerics) -> Numerics:
    """Numerics for most steps of a fit: those of the scene, or coarser ones."""
    if (scene.body, scene.friction) != (Scene.body, Scene.friction):
        return numerics
    fine = resolved(scene, numerics)
    if scene.in_space:
        links, longest = _COARSE_LIMBS
    else:
        per_segment, longest = _COARSE["all" if scene.between else "ends"]
        links = max(12, per_segment * len(scene.strip.segments))
    step = min(longest, min(scene.gait.ramp_times) / 40)
    links = min(links, fine.links)
    return replace(numerics, links=links, timestep=max(step, fine.timestep),
                   twists=min(fine.twists, links // 2))  # fmt: skip


@dataclass
class Predictor:
    """Prediction of each series for any values of the parameters.

    Args:
        base: tables of the scene.
        series: measurements.
        walk: model.
        numerics: function from a scene and its numerics to those to walk it with.
        pool: processes for many walks at once, if there are any.

    Values that the scene refuses, as those at which the strip would close into a circle, count as a
    walk that fails.

    Attributes:
        walks: number of walks so far.
        refused: reasons why the scene refused values, by what was refused.
    """

    base: Tables
    series: Sequence[Series]
    walk: Walk = by_mujoco
    numerics: Callable[[Scene, Numerics], Numerics] = lambda scene, numerics: numerics
    pool: ProcessPoolExecutor | None = None
    walks: int = 0
    refused: dict[str, str] = field(default_factory=dict)
    _motions: dict[str, Motion | None] = field(default_factory=dict)

    def __call__(
        self, values: Mapping[str, float], zeros: Mapping[int, float] = MappingProxyType({})
    ) -> list[Array]:
        """Predictions, one array per series, NaN where the walk failed.

        Args:
            values: of parameters, by name.
            zeros: pressures that sensors show where there is none, by offset [Pa].
        """
        self.all([values])
        return [self._of(series, values, zeros) for series in self.series]

    def all(self, points: Iterable[Mapping[str, float]]) -> None:
        """Walk at several points as one batch; later calls remember the walks."""
        todo: dict[str, tuple[Scene, Numerics]] = {}
        for values in points:
            for run in self._runs():
                key, tables = self._tables(values, run)
                if key in self._motions or key in todo:
                    continue
                try:
                    scene, numerics = build(tables)
                    todo[key] = scene, self.numerics(scene, numerics)
                except ValueError as error:
                    self._motions[key], self.refused[key] = None, str(error)
        jobs = [(*case, self._places) for case in todo.values()]
        use = self.pool.map if self.pool is not None and len(jobs) > 1 else map
        motions = use(self.walk, *zip(*jobs, strict=True)) if jobs else ()
        self._motions |= dict(zip(todo, motions, strict=True))
        self.walks += len(jobs)

    def derivatives(self, values: Mapping[str, float]) -> Array | None:
        """Derivatives of all numbers by the parameters, (count, P); None where they are not known.

        They are of distances and speeds of strips that walk quasi-statically.

        Args:
            values: of parameters, by name.
        """
        distances_alone = all(
            series.quantity in ("displacement", "speed") for series in self.series
        )
        if self.walk is not quasi_static or not distances_alone:
            return None
        slopes: dict[Run, Array] = {}
        for run in self._runs():
            _, tables = self._tables(values, run)
            derivatives = distance_slopes(tables, list(values), run.surface, _STATES)
            if derivatives is None:
                return None
            slopes[run] = np.array([*derivatives.values(), build(tables)[0].gait.period])
            self.walks += 1
        return np.array([
            slopes[run][:-1] / (slopes[run][-1] if series.quantity == "speed" else 1.0)
            for series in self.series for run in series.runs
        ])  # fmt: skip

    def changes(
        self, numerics: Callable[[Scene, Numerics], Numerics], values: Mapping[str, float]
    ) -> bool:
        """True if other numerics than the scene's would be walked, at values of the parameters.

        Raises:
            ValueError: the scene refuses the values.
        """
        if not self._runs():
            return False
        scene, fine = build(with_values(self.base, values))
        return resolved(scene, numerics(scene, fine)) != resolved(scene, fine)

    @property
    def _places(self) -> tuple[float, ...]:
        marked = {series.place for series in self.series if series.quantity in ("x", "z")}
        return tuple(sorted({0.0, 1.0, *marked}))

    def _runs(self) -> list[Run]:
        walked = [run for series in self.series if series.quantity != "angle"
                  for run in series.runs]  # fmt: skip
        return list(dict.fromkeys(walked))

    def _tables(self, values: Mapping[str, float], run: Run) -> tuple[str, Tables]:
        tables = with_values(self.base, values, dict(run.fields), run.surface)
        return json.dumps(tables, sort_keys=True, default=str), tables

    def _of(self, series: Series, values: Mapping[str, float], zeros: Mapping[int, float]) -> Array:
        if series.quantity == "angle":
            zero = 0.0 if series.offset is None else zeros.get(series.offset, 0.0)
            return self._angle(series._replace(at=series.at - zero), values)
        motions = [self._motions[self._tables(values, run)[0]] for run in series.runs]
        if series.abscissa == RUN:
            return np.array([_number(series, motion) for motion in motions])
        (motion,) = motions
        if motion is None:
            return np.full(len(series.at), np.nan)
        if series.at.max() > motion.time[-1] + 1e-6:
            raise ValueError(
                f"{series.name}: time {series.at.max():g} s is after the end of the walk at "
                f"{motion.time[-1]:g} s: give more cycles"
            )
        place = {"left": 0.0, "right": 1.0}.get(series.quantity, series.place)
        track = (motion.z if series.quantity == "z" else motion.x)[:, motion.places.index(place)]
        return np.interp(series.at, motion.time, track)

    def _angle(self, series: Series, values: Mapping[str, float]) -> Array:
        key, tables = self._tables(values, series.runs[0])
        try:
            strip = limbs_of(robot_of(tables))[0].strip
        except ValueError as error:
            self.refused[key] = str(error)
            return np.full(len(series.at), np.nan)
        length = series.length or strip.length * (strip.borders[1] - strip.borders[0])
        return pneunet.natural_curvature(strip, series.at) * length


def _number(series: Series, motion: Motion | None) -> float:
    if motion is None:
        return math.nan
    return {"displacement": motion.displacement, "speed": motion.displacement / motion.period,
            "height": motion.height, "turn": motion.turn}[series.quantity]  # fmt: skip


def processes(runs: int, parameters: int) -> Pool | None:
    """Processes for the walks of a Jacobian, if they are many."""
    if runs * 2 * parameters < _MANY:
        return None
    return plugins.processes("mjsim.fitting.walks")
