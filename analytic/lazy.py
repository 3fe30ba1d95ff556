"""Public names of a package, each imported when it is first used."""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False  # in the words of typing, whose import takes longer than all of this
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any


def lazily(
    package: str, homes: Mapping[str, tuple[str, ...]]
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Functions for `__getattr__` and `__dir__` of a package, and its list `__all__`.

    Args:
        package: its name.
        homes: public names by the module that defines them.
    """
    home_of = {name: module for module, names in homes.items() for name in names}
    public = sorted(home_of)

    def attribute(name: str) -> Any:
        if name not in home_of:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(home_of[name]), name)
        setattr(import_module(package), name, value)  # found there from now on
        return value

    return attribute, lambda: public, public
