"""Many robots of one environment: strips side by side, or any robots one after the other."""

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mjsim.env.settings import Settings
from mjsim.env.task import FALL, Walker, commands, middle, sense
from mjsim.scene import Scene
from mjsim.simulation.side_by_side.layout import refusal
from mjsim.simulation.side_by_side.strips import StripBatch

Array = NDArray[np.float64]
Rows = NDArray[np.int_]


class Walkers(Protocol):
    """Robots of one layout.

    Attributes:
        scenes: theirs.
    """

    scenes: list[Scene]

    def reset(self, rows: Rows, scenes: Sequence[Scene]) -> Array:
        """Lay other robots on their grounds; returns their measurements, a row each, (R, M)."""
        ...

    def play(self, rows: Rows, actions: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
        """Measurements (R, M), rewards (R,) and falls (R,) of a control period."""
        ...

    def infos(self) -> dict[str, Any]:
        """State of the models, see mjsim.env.task.Walker.info, an array each."""
        ...


def walkers(settings: Settings, count: int, threads: int) -> Walkers:
    """Robots, stepped side by side where they can be.

    See mjsim.simulation.side_by_side.layout.refusal.

    Args:
        settings: of the environment.
        count: number of robots.
        threads: of MuJoCo, side by side.
    """
    scenes = [settings.scene(ground) for ground in settings.grounds]
    scenes.append(settings.draw(np.random.default_rng(0)))  # has what is drawn, as adhesion
    if not any(refusal(scene, settings.resolved) for scene in scenes):
        return _SideBySide(settings, count, threads)
    return _OneByOne(settings, count)


class _OneByOne:
    """Robots of single environments."""

    def __init__(self, settings: Settings, count: int) -> None:
        self.scenes = [settings.scene(settings.grounds[0])] * count
        self._settings = settings
        self._walkers: list[Walker | None] = [None] * count

    def reset(self, rows: Rows, scenes: Sequence[Scene]) -> Array:
        for row, scene in zip(rows.tolist(), scenes, strict=True):
            walker = self._walkers[row]
            if walker is None or scene != walker.scene:
                self._walkers[row] = Walker(scene, self._settings)
            else:
                walker.reset()
            self.scenes[row] = scene
        return np.array([walker.sense() for walker in self._at(rows)])

    def play(self, rows: Rows, actions: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
        walking = self._at(rows)
        for walker, action in zip(walking, actions, strict=True):
            walker.play(action, self._settings.steps)
        return (
            np.array([walker.sense() for walker in walking]),
            np.array([walker.reward for walker in walking]),
            np.array([walker.fallen for walker in walking]),
        )

    def infos(self) -> dict[str, Any]:
        each = [walker.info() for walker in self._at(np.arange(len(self.scenes)))]
        return _marked({name: np.array([info[name] for info in each]) for name in each[0]})

    def _at(self, rows: Rows) -> list[Walker]:
        return [walker for row in rows.tolist() if (walker := self._walkers[row])]


class _SideBySide:
    """Strips stepped by mujoco.batch.Batch; `infos` has their grounds alone."""

    def __init__(self, settings: Settings, count: int, threads: int) -> None:
        base = settings.scene(settings.grounds[0])
        self._strips = StripBatch([base] * count, settings.resolved, threads)
        self._settings, self._place = settings, np.zeros(count)
        self.scenes = self._strips.scenes

    def reset(self, rows: Rows, scenes: Sequence[Scene]) -> Array:
        *_, settled = self._strips.reset(rows, scenes)
        numbers, self._place[rows] = self._look(rows, settled.contact[:, -1])
        return numbers

    def play(self, rows: Rows, actions: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
        scenes = [self.scenes[row] for row in rows]
        valves = np.array([
            np.tile(commands(scene, action), (self._settings.steps, 1))
            for scene, action in zip(scenes, actions, strict=True)
        ])  # fmt: skip
        steps = self._strips.play(valves, rows)
        fallen = self._strips.stopped[rows]
        numbers, place = self._look(rows, steps.contact[:, -1])
        rewards = np.where(fallen, FALL, place - self._place[rows])
        self._place[rows] = place
        return numbers, rewards, fallen

    def infos(self) -> dict[str, Any]:
        return _marked({"surface": np.array([scene.ground.name for scene in self.scenes])})

    def _look(self, rows: Rows, contact: Array) -> tuple[Array, Array]:
        scenes, numerics = [self.scenes[row] for row in rows], self._settings.resolved
        qpos = self._strips.coordinates(rows)
        numbers = sense(scenes, numerics, self._strips.pressure[rows], qpos, contact)
        return numbers, middle(scenes, numerics, qpos)


def _marked(infos: dict[str, Array]) -> dict[str, Any]:
    """The infos with Gymnasium's masks, which say of which robots they are: of all."""
    return infos | {f"_{name}": np.ones(len(values), bool) for name, values in infos.items()}
