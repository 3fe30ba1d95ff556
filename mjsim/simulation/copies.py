"""Copies of simulations, which go on as the original would.

Bodies and friction hold views into MuJoCo's arrays, which a plain copy would leave behind, or cut
off. A view is written down as its place, and is read from there in the copy.
"""

import copy
import io
import pickle
import re
from bisect import bisect_right
from types import FunctionType, ModuleType
from typing import Any, Self

import mujoco
import numpy as np

from mjsim.model.compiled import Compiled, fields

_STRUCTURES = mujoco.MjModel.__module__
_NAMED = re.compile(r"_Mj(Model|Data)(\w+)Views")  # what model.joint("x") gives
_PLAIN = (type, ModuleType, str, bytes, int, float, complex, bool, type(None))


class Copied:
    """Base of simulations in MuJoCo, whole in copies: by `copy`, `deepcopy` and pickle.

    Laws and bodies of any kind are copied with it, with their state of the last step.

    Attributes:
        data: MuJoCo's, and its model.

    Raises:
        TypeError: on copying, if an attribute cannot be copied so; the message names it.
    """

    data: mujoco.MjData

    def __copy__(self) -> Self:
        return copy.deepcopy(self)

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        new = memo[id(self)] = type(self).__new__(type(self))
        kept: list[Any] = []
        written = _written(self, kept)
        _read(new, copy.deepcopy(self.data, memo), written, kept)
        return new

    def __getstate__(self) -> tuple[mujoco.MjData, bytes]:
        return self.data, _written(self)

    def __setstate__(self, state: tuple[mujoco.MjData, bytes]) -> None:
        _read(self, *state)


def _written(whole: Copied, kept: list[Any] | None = None) -> bytes:
    """Attributes of a simulation beside MuJoCo's memory, as bytes.

    Args:
        whole: the simulation.
        kept: where to put what a copy in this process shares; by reference to modules if None.
    """
    file = io.BytesIO()
    try:
        _Writer(file, whole, kept).dump(vars(whole))
    except (TypeError, AttributeError, ValueError, pickle.PicklingError) as error:
        name = type(whole).__name__
        raise TypeError(f"{name} cannot be copied with what is in it: {error}") from error
    return file.getvalue()


def _read(new: Copied, data: mujoco.MjData, written: bytes, kept: list[Any] | None = None) -> None:
    vars(new).update(_Reader(io.BytesIO(written), new, data, kept).load())


class _Writer(pickle.Pickler):
    """Writes places in MuJoCo's memory for what lies there."""

    def __init__(self, file: io.BytesIO, whole: Copied, kept: list[Any] | None) -> None:
        super().__init__(file, pickle.HIGHEST_PROTOCOL)
        self._kept = kept
        owners = {"data": whole.data, "model": whole.data.model}
        self._places: dict[int, tuple[Any, tuple[Any, ...]]] = {id(whole): (whole, ("whole",))}
        arrays = []
        for owner, memory in owners.items():
            self._places[id(memory)] = memory, (owner,)
            for name in fields(memory.__class__):
                value = getattr(memory, name)
                if isinstance(value, np.ndarray) and value.size:
                    arrays.append((value.ctypes.data, value.nbytes, owner, name))
                elif type(value).__module__ == _STRUCTURES:
                    self._places.setdefault(id(value), (value, ("part", owner, name)))
        self._arrays = sorted(arrays)

    def persistent_id(self, obj: Any) -> tuple[Any, ...] | None:
        """Name by which the reader finds what is not copied by its content."""
        if id(obj) in self._places:
            return self._places[id(obj)][1]
        if isinstance(obj, np.ndarray):
            return None if obj.flags.owndata or not obj.size else self._place(obj)
        if self._kept is not None and _shared(obj):
            self._kept.append(obj)
            return "kept", len(self._kept) - 1
        named = _NAMED.fullmatch(type(obj).__name__)
        return named and ("named", named[1].lower(), named[2].lower(), obj.id)

    def _place(self, view: Any) -> tuple[Any, ...] | None:
        low, high = np.lib.array_utils.byte_bounds(view)
        at = bisect_right(self._arrays, low, key=lambda array: array[0]) - 1
        if at < 0:
            return None
        begin, size, owner, name = self._arrays[at]
        if high > begin + size:
            return None
        return "view", owner, name, *_layout(view, begin)

    def reducer_override(self, obj: Any) -> Any:
        """Views stay views of one array."""
        base = getattr(obj, "base", None)
        if type(obj) is np.ndarray and type(base) is np.ndarray and base.flags.c_contiguous:
            return _view, (base, *_layout(obj, base.ctypes.data))
        return NotImplemented


class _Reader(pickle.Unpickler):
    """Finds in a copy of MuJoCo's memory what lies there."""

    def __init__(
        self, file: io.BytesIO, whole: Copied, data: mujoco.MjData, kept: list[Any] | None
    ) -> None:
        super().__init__(file)
        self._whole, self._kept = whole, kept or []
        self._owners = {"data": data, "model": data.model}

    def persistent_load(self, pid: tuple[Any, ...]) -> Any:
        """See _Writer.persistent_id."""
        match pid:
            case ("whole",):
                return self._whole
            case ("kept", int(number)):
                return self._kept[number]
            case ("part", owner, name):
                return getattr(self._owners[owner], name)
            case ("named", owner, kind, number):
                return getattr(self._owners[owner], kind)(number)
            case ("view", owner, name, *layout):
                return _view(getattr(self._owners[owner], name), *layout)
        return self._owners[pid[0]]


def _layout(view: Any, begin: int) -> tuple[Any, ...]:
    return view.shape, view.dtype, view.ctypes.data - begin, view.strides


def _view(base: Any, shape: Any, dtype: Any, offset: int, strides: Any) -> Any:
    return np.ndarray(shape, dtype, base, offset, strides)


def _shared(obj: Any) -> bool:
    """Tell whether a copy may have the same object, as it refers to nothing that is copied."""
    if isinstance(obj, type):
        local = (base for base in obj.__mro__ if "<locals>" in base.__qualname__)
        parts = (part for base in local for part in vars(base).values())
        inner = (getattr(part, "__func__", getattr(part, "fget", part)) for part in parts)
        return all(_shared(part) for part in inner if isinstance(part, FunctionType))
    if isinstance(obj, FunctionType):
        cells = [cell.cell_contents for cell in obj.__closure__ or ()]
        references = [*cells, *(obj.__defaults__ or ()), *(obj.__kwdefaults__ or {}).values()]
        return all(isinstance(part, _PLAIN) for part in references)
    return isinstance(obj, ModuleType | Compiled)
