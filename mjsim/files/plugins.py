"""Plugins: bodies and friction laws from modules and files, and their way to other processes.

A worker process imports the same plugins. Other bodies and laws that are registered in this process
reach it by pickle, which refers to the module of their class, the main one included.
"""

import hashlib
import importlib
import importlib.util
import pickle
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

from analytic.friction.laws import LAWS
from analytic.registry import Registry
from mjsim.files.processes import Pool, clean_start
from mjsim.scene.registry import BODIES

_KINDS: dict[str, Registry[Any]] = {"friction": LAWS, "body": BODIES}  # as a scene calls them
_loaded: list[str] = []


class Carried(NamedTuple):
    """Registered laws and bodies of a process, for another one.

    Attributes:
        plugins: modules, and absolute paths of files.
        things: kind and name of each law and body, and its pickle, or the error of pickling it.
    """

    plugins: tuple[str, ...]
    things: tuple[tuple[str, str, bytes | str], ...]


def load(words: Iterable[str]) -> None:
    """Import plugins, each once.

    Args:
        words: names of modules or paths of .py files, several with commas between.

    Raises:
        ValueError: one cannot be imported; the message names it.
    """
    for word in (part.strip() for text in words for part in text.split(",")):
        plugin = str(Path(word).resolve()) if word.endswith(".py") else word
        if plugin in _loaded:
            continue
        try:
            _import(plugin)
        except (Exception, SystemExit) as error:  # a plugin may do anything while it is imported
            raise ValueError(
                f"plugin must be a module or a .py file that can be imported, got {word!r}: "
                f"{type(error).__name__}: {error}"
            ) from error
        _loaded.append(plugin)


def _import(plugin: str) -> None:
    if not plugin.endswith(".py"):
        importlib.import_module(plugin)
        return
    path = Path(plugin)
    # one name in every process, by which pickle finds its classes
    name = f"plugin_{path.stem}_{hashlib.sha256(plugin.encode()).hexdigest()[:8]}"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    if str(path.parent) not in sys.path:
        sys.path.append(str(path.parent))  # for modules beside it
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise


def carried() -> Carried:
    """Laws and bodies that are registered in this process."""
    things = [
        (kind, name, _pickled(value))
        for kind, registry in _KINDS.items() for name, value in registry.registered.items()
    ]  # fmt: skip
    return Carried(tuple(_loaded), tuple(things))


def _pickled(value: Any) -> bytes | str:
    try:
        return pickle.dumps(value)
    except Exception as error:  # of any kind: the class is the user's
        return str(error)


def adopt(registered: Carried) -> None:
    """Register in this process the laws and bodies of another one.

    Those that cannot be imported here are refused in one line when a scene names them.
    """
    trouble = ""
    try:
        load(registered.plugins)
    except ValueError as error:
        trouble = f"{error}; "
    for kind, name, thing in registered.things:
        registry = _KINDS[kind]
        if isinstance(thing, bytes):
            try:
                registry[name] = pickle.loads(thing)
                continue
            except Exception as error:  # of the module of its class
                thing = str(error)
        if name not in registry.registered:
            registry.refuse(name, _refusal(kind, name, trouble + thing, registry.group))


def _refusal(kind: str, name: str, why: str, group: str) -> str:
    return (
        f"{kind} {name!r} is registered where other processes cannot import it ({why}): put its "
        f"class in a module that registers it, given as --plugin, or name it as an entry point of "
        f"{group!r}"
    )


def processes(
    preload: str, count: int | None = None, begin: Callable[[], None] | None = None
) -> Pool:
    """Start a pool of processes with the laws and bodies that are registered here now.

    Args:
        preload: module that is imported once for all of them.
        count: number of processes; one per core if None.
        begin: function that each calls first.
    """
    return Pool(count, clean_start(preload), _begin, begin, carried())


def _begin(begin: Callable[[], None] | None, registered: Carried) -> None:
    if begin is not None:
        begin()
    adopt(registered)
