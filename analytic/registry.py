"""Laws, bodies and the like by name: built in, of installed packages, or registered.

Packages name theirs as entry points, which are looked for and imported only when a name is asked
for that is neither built in nor registered.
"""

from collections.abc import Iterator, Mapping, MutableMapping
from functools import cached_property
from importlib.metadata import EntryPoint, entry_points
from typing import Any, TypeVar, cast

T = TypeVar("T")


class Registry(MutableMapping[str, T]):
    """Values by name; its names are all there are, its values are imported when asked for.

    Args:
        group: of entry points, each a class without arguments or an instance with that `name`.
        builtin: places of the built-in values, by name, as "module:attribute".
    """

    def __init__(self, group: str, builtin: Mapping[str, str]) -> None:
        self.group = group
        self._builtin = {name: EntryPoint(name, at, group) for name, at in builtin.items()}
        self._imported: dict[str, T] = {}
        self._registered: dict[str, T] = {}
        self._refused: dict[str, str] = {}

    @cached_property
    def _installed(self) -> dict[str, EntryPoint]:
        return {point.name: point for point in entry_points(group=self.group)}

    @property
    def registered(self) -> dict[str, T]:
        """Values that this process registered."""
        return dict(self._registered)

    def refuse(self, name: str, why: str) -> None:
        """Know a name, and say in one line why it cannot be had here."""
        self._refused[name] = why

    def __getitem__(self, name: str) -> T:
        """The value of a name.

        Raises:
            KeyError: there is no such name.
            ValueError: the value cannot be had here; the message says why.
        """
        if name in self._registered:
            return self._registered[name]
        if name in self._refused:
            raise ValueError(self._refused[name])
        if name not in self._imported:
            point = self._builtin.get(name) or self._installed[name]
            self._imported[name] = cast(T, _imported(point))
        return self._imported[name]

    def __setitem__(self, name: str, value: T) -> None:
        self._registered[name] = value

    def __delitem__(self, name: str) -> None:
        del self._registered[name]

    def clear(self) -> None:
        """Forget what was registered."""
        self._registered.clear()

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and (
            name in self._registered
            or name in self._builtin
            or name in self._refused
            or name in self._installed
        )

    def __iter__(self) -> Iterator[str]:
        sources = (self._builtin, self._installed, self._registered, self._refused)
        return iter(dict.fromkeys(name for source in sources for name in source))

    def __len__(self) -> int:
        return sum(1 for _ in self)


def _imported(point: EntryPoint) -> Any:
    where = f"entry point {point.name} = {point.value!r} of {point.group!r}"
    try:
        value = point.load()
        value = value() if isinstance(value, type) else value
    except Exception as error:  # whatever a package does while it is imported
        raise ValueError(f"{where} cannot be had: {type(error).__name__}: {error}") from error
    if getattr(value, "name", None) != point.name:
        raise ValueError(f"{where} must have that name, got {getattr(value, 'name', None)!r}")
    return value
