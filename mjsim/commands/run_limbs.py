"""What `undulator run` does with a robot of limbs."""

import hashlib
import json
import sys
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from analytic.scene.quadruped_gaits import QUADRUPED_GAITS
from analytic.scene.surface import SURFACES
from mjsim.files.cli import FAILED, bar, say, strict_json
from mjsim.results.limb_record import record, table
from mjsim.results.limb_walk import TreeWalk
from mjsim.results.provenance import provenance
from mjsim.scene.limbs import TreeNumerics, TreeScene
from mjsim.simulation.limbs import TreeSimulation


def run(
    program: str, cases: list[tuple[TreeScene, TreeNumerics]], out: Path, as_json: bool, video: bool
) -> int:
    """Walk each scene, print it beside the reference, write files; returns the exit code.

    Raises:
        ValueError: a scene cannot be simulated.
        OSError: a file cannot be written.
    """
    records, walks = [], []
    for scene, numerics in cases:
        name = file_name(scene, numerics)
        simulation = TreeSimulation(scene, numerics)
        total = round(scene.duration / numerics.timestep)
        with bar(f"simulating {scene.ground.name}", total) as advance:
            walk = simulation.run(progress=advance)
        failed = walk.status != "ok"
        path = out / f"{name}{'-failed' * failed}.nc"
        walk.save(path)
        records.append({**record(walk), "trajectory": str(path), "video": None,
                        "provenance": provenance(scene, numerics)})  # fmt: skip
        walks.append(walk)
        if failed:
            print(f"{program}: {scene.ground.name}: {walk.status} at t = {walk.time[-1]:.2f} s",
                  file=sys.stderr)  # fmt: skip
    if not as_json:
        say(table(records))
        sys.stdout.flush()  # the numbers come before any video is made
    if video:
        _film(program, walks, records)
    if as_json:
        say(strict_json({"runs": records} if len(records) > 1 else records[0]))
    else:
        for row in records:
            print(*(row[key] for key in ("trajectory", "video") if row[key]))
    return FAILED if any(row["status"] != "ok" for row in records) else 0


def _film(program: str, walks: list[TreeWalk], records: list[dict[str, Any]]) -> None:
    from mjsim.pictures import gl

    if gl.use_backend() is None:
        print(f"{program}: {gl.HELP}", file=sys.stderr)
        return
    from mjsim.pictures.limb_film import film

    done = [i for i, walk in enumerate(walks) if walk.status == "ok"]
    paths = [Path(records[i]["trajectory"]).with_suffix(".mp4") for i in done]
    film([walks[i] for i in done], paths)
    for i, path in zip(done, paths, strict=True):
        records[i]["video"] = str(path)


def file_name(scene: TreeScene, numerics: TreeNumerics) -> str:
    """File name of a run, alike for the same scene and numerics alone.

    The surface; what of gait and friction is not the default; and, where anything else is not, a
    digest of everything.
    """
    usual, words = TreeScene(), ["limbs", scene.ground.name]
    for word, default in ((scene.gait.name, usual.gait.name), (scene.friction, usual.friction)):
        words += [word] * (word != default)
    gaits = [usual.gait, *QUADRUPED_GAITS.values()]
    named = scene.ground == SURFACES.get(scene.ground.name) and scene.gait in gaits
    rest = {field.name for field in fields(scene)} - {"ground", "gait", "friction"}
    alike = all(getattr(scene, name) == getattr(usual, name) for name in rest)
    if not (named and alike and numerics == TreeNumerics()):
        described = json.dumps([repr(scene), asdict(numerics)], sort_keys=True)
        words.append(hashlib.sha256(described.encode()).hexdigest()[:8])
    return "-".join(words)
