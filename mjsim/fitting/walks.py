"""What a model says of what was measured: walks in MuJoCo, or quasi-static ones."""

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from analytic.prediction import Elastica, predict
from analytic.scene import pneunet
from analytic.scene.chain import node_positions
from mjsim.files import plugins
from mjsim.files.tables import Tables, build
from mjsim.fitting.observations import Run, Series
from mjsim.fitting.parameters import with_values
from mjsim.results.measures import measure
from mjsim.scene import Numerics, Scene, resolved
from mjsim.simulation.simulation import simulate

Array = NDArray[np.float64]

_STATES = 100  # of the quasi-static model in a ramp from no pressure to the peak
_COARSE = {
    "ends": (4, 0.02),
    "all": (8, 0.01),
}  # links a segment and time step [s]
_MANY = 24  # walks that are worth processes of their own; chosen


class Motion(NamedTuple):
    """What came of a run.

    Attributes:
        time: of the states since the first cycle began, (T,) [s].
        x, z: of points at `places`, (T, P) [m].
        places: over the length, (P,).
        displacement, height: of the left end per cycle, and the greatest height [m].
        period: of a cycle [s].
    """

    time: Array
    x: Array
    z: Array
    places: tuple[float, ...]
    displacement: float
    height: float
    period: float


Walk = Callable[[Scene, Numerics, tuple[float, ...]], Motion | None]
"""From a scene, and places to look at, to what came of it; None if it failed."""


def by_mujoco(scene: Scene, numerics: Numerics, places: tuple[float, ...]) -> Motion | None:
    """A walk in MuJoCo."""
    walk = simulate(scene, numerics)
    numbers = measure(walk)
    if numbers is None:
        return None
    length, rows = scene.robot.length, slice(walk.start, None)
    x, z = (part[rows] for part in walk.nodes())
    nodes = node_positions(scene.strip, walk.numerics.links)
    at = np.array(places) * length
    return Motion(
        walk.time[rows], CubicSpline(nodes, x, axis=1)(at), CubicSpline(nodes, z, axis=1)(at),
        places, numbers.displacement * length, numbers.amplitude * length, scene.gait.period,
    )  # fmt: skip


def quasi_static(scene: Scene, numerics: Numerics, places: tuple[float, ...]) -> Motion | None:
    """The same by the elastica that friction bends; valves are ideal in it."""
    fractions, times = scene.gait.path(_STATES, scene.cycles)
    found = predict(
        scene.strip, scene.gait, scene.ground, Elastica(60, scene.chamber),
        refinement=1, friction=scene.reference_friction, cycles=scene.cycles,
        path=scene.robot.peak_pressure * fractions, times=times,
    )  # fmt: skip
    if not math.isfinite(found.locomotion.per_cycle):
        return None
    x, z = found.shapes.curve(np.array(places) * scene.robot.length)
    return Motion(
        np.asarray(times), found.locomotion.left[:, None] + x, z, places,
        float(found.by_cycle[-1]), float(found.shapes.amplitude.max()), scene.gait.period,
    )  # fmt: skip


WALKS: dict[str, Walk] = {"mujoco": by_mujoco, "quasi-static": quasi_static}


def coarse(scene: Scene, numerics: Numerics) -> Numerics:
    """Numerics that find the way, if the scene's own are dearer."""
    if (scene.body, scene.friction) != (Scene.body, Scene.friction):
        return numerics
    a_segment, longest = _COARSE["all" if scene.between else "ends"]
    own = resolved(scene, numerics)
    links = max(12, a_segment * len(scene.strip.segments))
    step = min(longest, min(scene.gait.ramp_times) / 40)
    return replace(numerics, links=min(links, own.links), timestep=max(step, own.timestep))


@dataclass
class Predictor:
    """What the model says of each series, for any values of the parameters.

    Args:
        base: tables of the scene.
        series: what was measured.
        walk: the model.
        numerics: from a scene and its numerics to those to walk it with.
        pool: processes for many walks at once, if there are any.

    Attributes:
        walks: how many there were.
    """

    base: Tables
    series: Sequence[Series]
    walk: Walk = by_mujoco
    numerics: Callable[[Scene, Numerics], Numerics] = lambda scene, numerics: numerics
    pool: ProcessPoolExecutor | None = None
    walks: int = 0
    _known: dict[str, Any] = field(default_factory=dict)

    def __call__(self, values: Mapping[str, float]) -> list[Array]:
        """Predictions, one array a series, NaN where the walk failed."""
        return self.all([values])[0]

    def all(self, points: Iterable[Mapping[str, float]]) -> list[list[Array]]:
        """The same at several points, their walks as one batch."""
        points = list(points)
        todo: dict[str, tuple[Scene, Numerics]] = {}
        for values in points:
            for run in self._runs():
                key, tables = self._tables(values, run)
                if key not in self._known and key not in todo:
                    scene, numerics = build(tables)
                    todo[key] = scene, self.numerics(scene, numerics)
        jobs = [(*case, self._places) for case in todo.values()]
        if self.pool is not None and len(jobs) > 1:
            done = list(self.pool.map(self.walk, *zip(*jobs, strict=True)))
        else:
            done = [self.walk(*job) for job in jobs]
        self.walks += len(jobs)
        self._known |= dict(zip(todo, done, strict=True))
        return [[self._of(series, values) for series in self.series] for values in points]

    def changes(self, numerics: Callable[[Scene, Numerics], Numerics]) -> bool:
        """Whether others than the scene's own would be walked."""
        scene, own = build(self.base)
        return self._walked(scene, numerics(scene, own)) != self._walked(scene, own)

    @staticmethod
    def _walked(scene: Scene, numerics: Numerics) -> Numerics:
        return resolved(scene, numerics)

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

    def _of(self, series: Series, values: Mapping[str, float]) -> Array:
        if series.quantity == "angle":
            return self._angle(series, values)
        motions = [self._known[self._tables(values, run)[0]] for run in series.runs]
        if len(motions) > 1 or series.quantity in ("displacement", "speed", "height"):
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
        run = series.runs[0]
        robot = build(self._tables(values, run)[1])[0].strip
        length = series.length or robot.length * (robot.borders[1] - robot.borders[0])
        return pneunet.natural_curvature(robot, series.at) * length


def _number(series: Series, motion: Motion | None) -> float:
    if motion is None:
        return math.nan
    return {"displacement": motion.displacement, "speed": motion.displacement / motion.period,
            "height": motion.height}[series.quantity]  # fmt: skip


def processes(runs: int, parameters: int) -> ProcessPoolExecutor | None:
    """Processes for the walks of a Jacobian, if they are many."""
    if runs * 2 * parameters < _MANY:
        return None
    return plugins.processes("mjsim.fitting.walks")
