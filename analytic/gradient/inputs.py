"""Fields of a scene by name, and small changes of their numbers."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.checks import meant
from analytic.friction.laws import Friction
from analytic.scene.gait import Gait
from analytic.scene.robot import Robot
from analytic.scene.surface import Surface

Array = NDArray[np.float64]

_STEP = 3e-5  # of a number, in differences of conditions of balance; chosen
_FROM_ZERO = {"robot": 1e-6, "surface": 1e-3, "gait": 1e-5, "friction": 1e-5}  # in SI; chosen


@dataclass(frozen=True)
class Inputs:
    """Scene that a distance is of.

    Attributes:
        robot, gait, surface, friction: see analytic.prediction.predict.
    """

    robot: Robot
    gait: Gait
    surface: Surface
    friction: Friction

    def of(self, name: str) -> Any:
        """Value of a field such as robot.length.

        Raises:
            ValueError: there is no such field, or it has no number.
        """
        table, _, key = name.partition(".")
        if table not in _TABLES:
            raise ValueError(f"a field to differentiate by must be of {', '.join(_TABLES)}, as "
                             f"robot.length is; got {name!r}")  # fmt: skip
        part: Any = getattr(self, table)
        keys = [item.name for item in fields(part)]
        if key not in keys:
            raise ValueError(f"field {name!r} is unknown; known of {table} are {', '.join(keys)}"
                             f"{meant(key, keys)}")  # fmt: skip
        value = getattr(part, key)
        if not _is_numbers(value):
            raise ValueError(f"field {name} must have a number to differentiate by, got {value!r}")
        return value

    def changed(self, name: str, index: tuple[int, ...], by: float) -> "Inputs":
        """The scene with one number of a field changed; the last stage of a cycle is the first.

        Raises:
            ValueError: the field may not have that value.
        """
        table, _, key = name.partition(".")
        values = np.array(self.of(name), dtype=float)
        values[index] += by
        if name == "gait.stages" and self.gait.repeats and index[0] == 0:
            values[-1] = values[0]
        new = float(values) if not values.ndim else _tuples(values.tolist())
        return replace(self, **{table: replace(getattr(self, table), **{key: new})})

    def numbers(self, name: str) -> "tuple[Number, ...]":
        """Numbers of a field, the stages of a cycle without the last."""
        values = np.array(self.of(name), dtype=float)
        if name == "gait.stages" and self.gait.repeats:
            values = values[:-1]
        return tuple(self._number(name, index, float(values[index]))
                     for index in np.ndindex(values.shape))  # fmt: skip

    def _number(self, name: str, index: tuple[int, ...], value: float) -> "Number":
        step = _STEP * abs(value) or _FROM_ZERO[name.partition(".")[0]]
        if name == "gait.stages":
            step = _STEP
        ways = [way for way in (1, -1) if self._may(name, index, 2 * way * step)]
        # the rigidity depends on the size of a pressure, with a corner at 0
        corner = name == "gait.stages" and value == 0.0
        way = 0 if len(ways) == 2 and not corner else ways[0] if ways else 0
        return Number(name, index, value, step if ways else 0.0, way)

    def _may(self, name: str, index: tuple[int, ...], by: float) -> bool:
        try:
            self.changed(name, index, by)
        except ValueError:
            return False
        return True


_TABLES = tuple(item.name for item in fields(Inputs))


class Number(NamedTuple):
    """One number of a field.

    Attributes:
        name, place: of the field, and its place in it.
        value: of the number.
        step: of differences; 0 if it cannot be changed.
        way: 1 or -1 if it can be changed that way only, or has a corner there; 0 if both.
    """

    name: str
    place: tuple[int, ...]
    value: float
    step: float
    way: int

    def acts_on(self, ramp: int, ramps: int) -> bool:
        """Tell whether it changes anything on a ramp of a gait of so many."""
        if self.name != "gait.stages":
            return True
        return self.place[0] % ramps in (ramp, (ramp + 1) % ramps)

    def derivative(self, function: Callable[[Inputs], Array], inputs: Inputs) -> Array:
        """Derivative of a smooth function, by differences of second order."""
        weights: Sequence[tuple[int, float]] = ((-1, -0.5), (1, 0.5))
        if self.way:
            weights = ((0, -1.5 * self.way), (self.way, 2.0 * self.way),
                       (2 * self.way, -0.5 * self.way))  # fmt: skip
        values = [weight * function(inputs.changed(self.name, self.place, steps * self.step))
                  for steps, weight in weights]  # fmt: skip
        return np.asarray(sum(values) / self.step)


@dataclass(frozen=True)
class Derivative:
    """Derivative of the distance per cycle by one field of a scene.

    Attributes:
        value: by the number [m per its unit]; of fields of several numbers their shape, of the
            stages of a cycle (ramps, S); NaN where there is none.
        reason: why there is none, or what holds of it; empty if it is two-sided.
    """

    value: Array
    reason: str = ""


def _is_numbers(value: Any) -> bool:
    if value is None or isinstance(value, bool | str) or is_dataclass(value):
        return False
    try:
        return bool(np.isfinite(np.array(value, dtype=float)).all() and np.size(value))
    except (TypeError, ValueError):
        return False


def _tuples(values: Any) -> Any:
    return tuple(map(_tuples, values)) if isinstance(values, list) else values
