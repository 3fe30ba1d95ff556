"""Forms of what TerreSoRo-IV may remember, and of what else its hub may do, beside no memory.

Each is a law of (values, past, after) -> motions (N, 3). The first eight values are those of
`hub.Numbers`, the ninth the lag of curling, of all forms but the first and the dry one.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from studies import Array
from zoo.terresoro_iv.model import Lagged, amounts, moved

Motions = Callable[[Array, Array, Array], Array]


class Form(NamedTuple):
    """A law of motions, and the values beyond those of the lagged hub that leave it as it is."""

    law: Motions
    neutral: tuple[float, ...] = ()
    numbers: int = 9


def no_memory(values: Array, past: Array, after: Array) -> Array:
    """Each transition begins with limbs flat or curled."""
    numbers = Lagged(*values[:8])
    before = past[:, -1]
    return moved([before, after], numbers.hub.bounds(before, after), numbers)


def dry(values: Array, past: Array, after: Array) -> Array:
    """No viscous part, and a lag."""
    return _lagged(np.array([*values[:7], -np.inf, values[7]]), past, after)


def _lagged(values: Array, past: Array, after: Array, factor: Array | float = 1.0) -> Array:
    numbers = Lagged(*values[:9])
    begin, end = amounts(past, after, numbers.lag)
    return moved([begin, end], factor * numbers.hub.bounds(past[:, -1], after), numbers)


def lag_of_both(values: Array, past: Array, after: Array) -> Array:
    """Uncurling lags too."""
    numbers = Lagged(*values[:9])
    begin, end = amounts(past, after, numbers.lag, float(values[9]))
    return moved([begin, end], numbers.hub.bounds(past[:, -1], after), numbers)


def fresh_contact(values: Array, past: Array, after: Array) -> Array:
    """A contact that rests since one transition alone holds otherwise, as friction that ages."""
    fresh = (past[:, -1] == after) & (past[:, -2] != after)
    return _lagged(values, past, after, np.where(fresh, np.exp(values[9]), 1.0))


def load(values: Array, past: Array, after: Array) -> Array:
    """Resting limbs hold otherwise the more limbs are curled."""
    curled = 0.5 * (past[:, -1] + after).sum(axis=1, keepdims=True) - 2.0
    return _lagged(
        values, past, after, np.where(past[:, -1] == after, np.exp(values[9] * curled), 1.0)
    )


def supply(values: Array, past: Array, after: Array) -> Array:
    """The lag is longer the more limbs curl at once."""
    numbers, before = Lagged(*values[:9]), past[:, -1]
    many = ((after == 1) & (before == 0)).sum(axis=1, keepdims=True)
    begin, _ = amounts(past, after, numbers.lag)
    lag = np.clip(numbers.lag + values[9] * (many - 1.5), 0.0, 0.9)
    end = after + np.where(after == 1, lag, 0.0) * (begin - after)
    return moved([begin, end], numbers.hub.bounds(before, after), numbers)


def unlike_limbs(values: Array, past: Array, after: Array) -> Array:
    """Each limb has a factor of its own on its friction."""
    return _lagged(values, past, after, np.exp(np.array([*values[9:12], -values[9:12].sum()])))


def order(values: Array, past: Array, after: Array, parts: int = 5) -> Array:
    """Limbs that curl start later than those that uncurl, by a part of a transition."""
    numbers, before = Lagged(*values[:9]), past[:, -1]
    begin, end = amounts(past, after, numbers.lag)
    late, early = np.clip(values[9], 0.0, 0.8), np.clip(-values[9], 0.0, 0.8)

    def progress(part: float) -> Array:
        curls, uncurls = (np.clip((part - wait) / (1 - late - early), 0.0, 1.0)
                          for wait in (late, early))  # fmt: skip
        return np.where(after > before, curls, uncurls)

    return moved([begin + progress(k / parts) * (end - begin) for k in range(parts + 1)],
                 numbers.hub.bounds(before, after), numbers)  # fmt: skip


FORMS = {
    "no memory": Form(no_memory, numbers=8),
    "lag of curling": Form(_lagged),
    "lag, dry friction": Form(dry, numbers=8),
    "lag of both": Form(lag_of_both, (0.01,), 10),
    "lag, fresh contacts": Form(fresh_contact, (0.0,), 10),
    "lag, load": Form(load, (0.0,), 10),
    "lag by how many curl": Form(supply, (0.0,), 10),
    "lag, order of curling": Form(order, (0.05,), 10),
    "lag, unlike limbs": Form(unlike_limbs, (0.0, 0.0, 0.0), 12),
}
