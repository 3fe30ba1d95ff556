"""Origin of a result: versions, commit, resolved configuration."""

import os
import platform
import subprocess
from dataclasses import asdict, fields, is_dataclass
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any, TypeVar

from analytic import Gait, Patches, Robot, Surface
from analytic.scene.actuator import Actuator
from analytic.scene.limbs import Limb, LimbedRobot
from mjsim.scene import Numerics, Resolved, Scene, Valves, resolved

Kind = TypeVar("Kind")

_RENAMED = {"elements": "links"}  # of the numerics, in older files
_RENAMED_BODY = {"planar": "chain"}

DISTRIBUTION = "undulator"
_PACKAGES = (DISTRIBUTION, "mujoco", "dm_control", "numpy", "scipy")


@cache
def origin() -> dict[str, Any]:
    """The versions and the commit that a result was made with."""
    return {
        "versions": {"python": platform.python_version(), **versions()},
        "commit": _commit(),
    }


@cache
def signature() -> dict[str, Any]:
    """Versions and commit as words for the columns of a table, `versions` and `commit`."""
    source = origin()
    versions = " ".join(f"{name}={version}" for name, version in source["versions"].items())
    return {"versions": versions, "commit": source["commit"] or ""}


def machine() -> str:
    """Kind of this machine, in a few words."""
    return f"{platform.machine()} {platform.system()} {os.cpu_count()} cores"


def provenance(scene: Scene, numerics: Numerics) -> dict[str, Any]:
    """Plain data from which a result can be made again."""
    described = {field.name: _plain(getattr(scene, field.name)) for field in fields(scene)}
    return {**origin(), "scene": described, "numerics": asdict(numerics)}


def _plain(value: Any) -> Any:
    """A part of a scene as plain data; of the ground of a plugin its name."""
    if is_dataclass(value) and not isinstance(value, type):
        return asdict(value)
    return value if isinstance(value, str | int | float | None) else value.name


def configuration(described: dict[str, Any]) -> tuple[Scene, Resolved]:
    """The scene and numerics that `provenance` described.

    Raises:
        KeyError, TypeError, ValueError: `described` is no such description, or of a ground that
            this version does not know.
    """
    values, numbers = dict(described["scene"]), dict(described["numerics"])
    for old, new in _RENAMED.items():
        if old in numbers:
            numbers[new] = numbers.pop(old)
    numbers.setdefault("twists", 0)  # files without it are of limbs that did not twist
    body = values.get("body", Scene.body)
    values["body"] = _RENAMED_BODY.get(body, body)
    if isinstance(values["ground"], dict) and "borders" in values["ground"]:
        patches = values["ground"]
        surfaces = tuple(_made(Surface, surface, "surface") for surface in patches["surfaces"])
        values["ground"] = Patches(patches["name"], tuple(patches["borders"]), surfaces)
    else:
        values["ground"] = _made(Surface, values["ground"], "ground")
    values["gait"] = _made(Gait, values["gait"], "gait")
    if "limbs" in values["robot"]:
        limbs = tuple(
            _made(Limb, {**limb, "strip": _strip(limb["strip"], "strip")}, "limb")
            for limb in values["robot"]["limbs"]
        )
        values["robot"] = LimbedRobot(limbs, values["robot"]["peak_pressure"])
    else:
        values["robot"] = _strip(values["robot"], "robot")
    values["valves"] = _made(Valves, values.get("valves", {}), "valves")
    scene = Scene(**values)
    return scene, resolved(scene, _made(Numerics, numbers, "numerics"))


def _made(kind: type[Kind], table: Any, name: str) -> Kind:
    if not isinstance(table, dict):
        raise ValueError(f"{name} {table!r} was not one of this program")
    names = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    for key in table:
        if key not in names:
            raise ValueError(f"key {key!r} of {name} is unknown; known are {', '.join(names)}")
    return kind(**{key: _frozen(value) for key, value in table.items()})


def _strip(table: Any, name: str) -> Robot:
    """A strip with the curves of its actuators."""
    given = table.get("actuator") if isinstance(table, dict) else None
    if given is None:
        return _made(Robot, table, name)
    several = isinstance(given, list)
    curves = tuple(_made(Actuator, curve, "actuator") for curve in (given if several else [given]))
    return _made(Robot, {**table, "actuator": curves if several else curves[0]}, name)


def _frozen(value: Any) -> Any:
    """Lists, which JSON makes of tuples, as tuples again."""
    return tuple(_frozen(item) for item in value) if isinstance(value, list | tuple) else value


def versions() -> dict[str, str]:
    """Versions of the packages that a result depends on."""
    installed = {}
    for name in _PACKAGES:
        try:
            installed[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            installed[name] = "not installed"
    return installed


def _commit() -> str | None:
    """Commit of the checkout this code runs from, with "+" if it was changed; None if none."""
    top = Path(__file__).resolve().parent.parent.parent
    if not (top / ".git").exists():
        return None
    try:
        run = subprocess.run(
            ["git", "-C", str(top), "describe", "--always", "--dirty=+", "--exclude=*"],
            capture_output=True, text=True, timeout=10, check=False,
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return None
    return run.stdout.strip() or None
