"""A model as it was compiled, to be put back whole."""

import copy
from functools import cache
from typing import Any

import mujoco
import numpy as np


class Compiled:
    """Numbers of a model as compiled: every array, and the options, statistics and visuals.

    Args:
        model: which bodies and friction may change wherever they like.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._kept = copy.copy(model)

    def restore(self, model: mujoco.MjModel) -> None:
        """Make a model what it was, in place: views into its arrays stay valid."""
        _put(self._kept, model)


def _put(kept: Any, live: Any) -> None:
    for name in fields(kept.__class__):
        value = getattr(kept, name)
        if isinstance(value, np.ndarray):
            getattr(live, name)[...] = value
        elif type(value).__module__ == type(kept).__module__:  # options and the like
            _put(value, getattr(live, name))
        elif not isinstance(kept, mujoco.MjModel):  # its numbers are sizes of arrays
            setattr(live, name, value)


@cache
def fields(kind: type) -> tuple[str, ...]:
    """Names of a MuJoCo structure's attributes, without its methods."""
    return tuple(
        name for name in dir(kind)
        if not name.startswith("_") and not callable(getattr(kind, name))
    )  # fmt: skip
