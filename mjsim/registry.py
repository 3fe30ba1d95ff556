"""Bodies by name; a body's module is imported when it is first built."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mjsim.bodies.body import Body

_MODULES = {name: f"mjsim.bodies.{name}" for name in ("planar", "cable", "rod")}
_registered: "dict[str, Body]" = {}


def names() -> tuple[str, ...]:
    """Every body that a scene can name."""
    return (*_MODULES, *(name for name in _registered if name not in _MODULES))


def register(body: "Body") -> None:
    """Make a body known by its name."""
    _registered[body.name] = body


def find(name: str) -> "Body":
    """The body of a name.

    Raises:
        KeyError: there is none.
    """
    if name not in _registered:
        register(import_module(_MODULES[name]).BODY)
    return _registered[name]
