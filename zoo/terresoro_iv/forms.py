"""Forms of what TerreSoRo-IV may remember, and of how its contacts resist.

Each is a law of (values, past, after) -> motions (N, 3). The first seven values are those of
`model.Lagged`, but of the form without memory, which has no lag, and of dry friction alone, which
has nothing viscous.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from studies import Array
from zoo.terresoro_iv.hub import spread_places
from zoo.terresoro_iv.model import FORM, Lagged, amounts, moved
from zoo.terresoro_iv.outline import flat_place

_NONE = -6.0  # of a logarithm, below which a resistance is none and its fit would run away
Motions = Callable[[Array, Array, Array], Array]


class Form(NamedTuple):
    """A law of motions, the values at which it is `model.FORM`, or where its fit begins."""

    law: Motions
    neutral: tuple[float, ...] = ()
    numbers: int = 7
    extends: bool = True


def _lagged(values: Array, past: Array, after: Array, factor: Array | float = 1.0) -> Array:
    numbers = Lagged(*values[:7])
    begin, end = amounts(past, after, numbers.lag)
    viscous = np.exp(numbers.viscous) * numbers.factors(past[:, -1], after)
    dry = np.ones_like(viscous)
    return moved([begin, end], factor * dry, factor * viscous, numbers.places)


def no_memory(values: Array, past: Array, after: Array) -> Array:
    """Each transition begins with limbs flat or curled."""
    return _lagged(np.array([*values[:6], 0.0]), past, after)


def dry_alone(values: Array, past: Array, after: Array) -> Array:
    """Dry friction by state, nothing viscous, and a lag."""
    numbers = Lagged(*np.insert(values, 5, -np.inf))
    begin, end = amounts(past, after, numbers.lag)
    dry = numbers.factors(past[:, -1], after)
    return moved([begin, end], dry, np.zeros_like(dry), numbers.places)


def both_by_state(values: Array, past: Array, after: Array) -> Array:
    """Dry friction is by state as the viscous one is."""
    numbers = Lagged(*values[:7])
    begin, end = amounts(past, after, numbers.lag)
    dry = numbers.factors(past[:, -1], after)
    return moved([begin, end], dry, np.exp(numbers.viscous) * dry, numbers.places)


def dry_by_state(values: Array, past: Array, after: Array) -> Array:
    """Dry friction is by state, the viscous one alike at all contacts."""
    numbers = Lagged(*np.concatenate([values[:2], np.maximum(values[2:5], _NONE), values[5:7]]))
    begin, end = amounts(past, after, numbers.lag)
    dry = numbers.factors(past[:, -1], after)
    return moved([begin, end], dry, np.full_like(dry, np.exp(numbers.viscous)), numbers.places)


def free_place(values: Array, past: Array, after: Array) -> Array:
    """Contacts of flat limbs are fitted too, as if there were no photograph."""
    numbers = Lagged(*values[:7])
    begin, end = amounts(past, after, numbers.lag)
    viscous = np.exp(numbers.viscous) * numbers.factors(past[:, -1], after)
    places = spread_places(values[7], values[8]), numbers.places[1]
    return moved([begin, end], np.ones_like(viscous), viscous, places)


def lag_of_both(values: Array, past: Array, after: Array) -> Array:
    """Uncurling lags too."""
    numbers = Lagged(*values[:7])
    begin, end = amounts(past, after, numbers.lag, float(values[7]))
    viscous = np.exp(numbers.viscous) * numbers.factors(past[:, -1], after)
    return moved([begin, end], np.ones_like(viscous), viscous, numbers.places)


def fresh_contact(values: Array, past: Array, after: Array) -> Array:
    """A contact that rests since one transition alone resists otherwise, as friction that ages."""
    fresh = (past[:, -1] == after) & (past[:, -2] != after)
    return _lagged(values, past, after, np.where(fresh, np.exp(values[7]), 1.0))


def load(values: Array, past: Array, after: Array) -> Array:
    """Resting limbs resist otherwise the more limbs are curled."""
    curled = 0.5 * (past[:, -1] + after).sum(axis=1, keepdims=True) - 2.0
    return _lagged(
        values, past, after, np.where(past[:, -1] == after, np.exp(values[7] * curled), 1.0)
    )


def diagonal_load(values: Array, past: Array, after: Array) -> Array:
    """Four stiff limbs carry more, and resist more, where a diagonal is more curled."""
    diagonal = np.array([1.0, -1.0, 1.0, -1.0])
    curled = 0.5 * (past[:, -1] + after)
    tall = (curled * diagonal).sum(axis=1, keepdims=True)
    return _lagged(values, past, after, np.maximum(1.0 + values[7] * diagonal * tall, 1e-3))


def supply(values: Array, past: Array, after: Array) -> Array:
    """The lag is longer the more limbs curl at once."""
    numbers, before = Lagged(*values[:7]), past[:, -1]
    many = ((after == 1) & (before == 0)).sum(axis=1, keepdims=True)
    begin, _ = amounts(past, after, numbers.lag)
    lag = np.clip(numbers.lag + values[7] * (many - 1.5), 0.0, 0.9)
    end = after + np.where(after == 1, lag, 0.0) * (begin - after)
    viscous = np.exp(numbers.viscous) * numbers.factors(before, after)
    return moved([begin, end], np.ones_like(viscous), viscous, numbers.places)


def unlike_limbs(values: Array, past: Array, after: Array) -> Array:
    """Each limb has a factor of its own on its friction."""
    return _lagged(values, past, after, np.exp(np.array([*values[7:10], -values[7:10].sum()])))


def order(values: Array, past: Array, after: Array, parts: int = 5) -> Array:
    """Limbs that curl start later than those that uncurl, by a part of a transition."""
    numbers, before = Lagged(*values[:7]), past[:, -1]
    begin, end = amounts(past, after, numbers.lag)
    late, early = np.clip(values[7], 0.0, 0.8), np.clip(-values[7], 0.0, 0.8)

    def progress(part: float) -> Array:
        curls, uncurls = (np.clip((part - wait) / (1 - late - early), 0.0, 1.0)
                          for wait in (late, early))  # fmt: skip
        return np.where(after > before, curls, uncurls)

    viscous = np.exp(numbers.viscous) * numbers.factors(before, after)
    curled = [begin + progress(k / parts) * (end - begin) for k in range(parts + 1)]
    return moved(curled, np.ones_like(viscous), viscous, numbers.places)


FORMS = {
    "no memory": Form(no_memory, numbers=6, extends=False),
    FORM: Form(_lagged),
    "dry alone, by state": Form(dry_alone, (9.0, 5.0, 0.1, 0.7, 0.3, 0.2), 6, extends=False),
    "dry by state": Form(dry_by_state, (7.8, 4.86, 1.1, 1.2, -3.0, 0.4, 0.23), extends=False),
    "both by state": Form(both_by_state, extends=False),
    "free flat contact": Form(free_place, flat_place(), 9),
    "lag of both": Form(lag_of_both, (0.01,), 8),
    "fresh contacts": Form(fresh_contact, (0.0,), 8),
    "load": Form(load, (0.0,), 8),
    "load by diagonals": Form(diagonal_load, (0.0,), 8),
    "lag by how many curl": Form(supply, (0.0,), 8),
    "order of curling": Form(order, (0.05,), 8),
    "unlike limbs": Form(unlike_limbs, (0.0, 0.0, 0.0), 10),
}
