"""What a result was made from: versions, commit, resolved configuration."""

import os
import platform
import subprocess
from dataclasses import asdict, fields, is_dataclass
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from analytic import Gait, Patches, Robot, Surface
from mjsim.scene import Numerics, Scene, Valves

DISTRIBUTION = "undulator"
_PACKAGES = (DISTRIBUTION, "mujoco", "dm_control", "numpy", "scipy")


def origin() -> dict[str, Any]:
    """The versions and the commit that a result was made with."""
    return {
        "versions": {"python": platform.python_version(), **versions()},
        "commit": _commit(),
    }


@cache
def signature() -> dict[str, Any]:
    """The same as words for a table's columns, `versions` and `commit`."""
    source = origin()
    versions = " ".join(f"{name}={version}" for name, version in source["versions"].items())
    return {"versions": versions, "commit": source["commit"] or ""}


def machine() -> str:
    """What kind of machine this is, in a few words."""
    return f"{platform.machine()} {platform.system()} {os.cpu_count()} cores"


def provenance(scene: Scene, numerics: Numerics) -> dict[str, Any]:
    """Plain data that says how to make a result again."""
    ground = scene.ground
    plain = asdict(ground) if is_dataclass(ground) and not isinstance(ground, type) else ground.name
    described = {field.name: getattr(scene, field.name) for field in fields(scene)}
    described |= {"robot": asdict(scene.robot), "gait": asdict(scene.gait), "ground": plain}
    described["valves"] = asdict(scene.valves)
    return {**origin(), "scene": described, "numerics": asdict(numerics)}


def configuration(described: dict[str, Any]) -> tuple[Scene, Numerics]:
    """The scene and numerics that `provenance` described.

    Raises:
        KeyError, TypeError, ValueError: `described` is no such description, or of a ground that
            this version does not know.
    """
    scene = dict(described["scene"])
    if isinstance(scene["ground"], dict) and "borders" in scene["ground"]:
        patches = scene["ground"]
        surfaces = tuple(Surface(**surface) for surface in patches["surfaces"])
        scene["ground"] = Patches(patches["name"], tuple(patches["borders"]), surfaces)
    for name, kind in (("robot", Robot), ("gait", Gait), ("ground", Surface), ("valves", Valves)):
        if isinstance(scene[name], Patches):
            continue
        if not isinstance(scene[name], dict):
            raise ValueError(f"{name} {scene[name]!r} was not one of this program")
        known = {field.name for field in fields(kind)}
        for key in scene[name]:
            if key not in known:
                raise ValueError(f"key {key!r} of {name} is unknown; known are {', '.join(known)}")
        scene[name] = kind(**{key: _frozen(value) for key, value in scene[name].items()})
    return Scene(**scene), Numerics(**described["numerics"])


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
