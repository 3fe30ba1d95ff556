"""What `python -m mjsim.run` does with a robot of limbs."""

import hashlib
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

from mjsim.io.cli import FAILED, bar, say, strict_json
from mjsim.tree.record import record, table
from mjsim.tree.scene import TreeNumerics, TreeScene
from mjsim.tree.simulation import TreeSimulation
from mjsim.tree.walk import TreeWalk, provenance


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
        simulation = TreeSimulation(scene, numerics)
        total = round(scene.duration / numerics.timestep)
        with bar(f"simulating {scene.ground.name}", total) as advance:
            walk = simulation.run(progress=advance)
        failed = walk.status != "ok"
        path = out / f"{file_name(walk)}{'-failed' * failed}.nc"
        walk.save(path)
        records.append({**record(walk), "trajectory": str(path), "video": None,
                        "provenance": provenance(walk)})  # fmt: skip
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
    from mjsim.video import gl

    if gl.use_backend() is None:
        print(f"{program}: {gl.HELP}", file=sys.stderr)
        return
    from mjsim.tree.film import film

    done = [i for i, walk in enumerate(walks) if walk.status == "ok"]
    paths = [Path(records[i]["trajectory"]).with_suffix(".mp4") for i in done]
    film([walks[i] for i in done], paths)
    for i, path in zip(done, paths, strict=True):
        records[i]["video"] = str(path)


def file_name(walk: TreeWalk) -> str:
    """File name of a run, alike for the same scene and numerics alone."""
    scene, usual = walk.scene, TreeScene(ground=walk.scene.ground)
    words = ["limbs", scene.ground.name]
    if scene.gait != usual.gait:
        words.append(scene.gait.name)
    if (scene, walk.numerics) != (usual, TreeNumerics()):
        described = json.dumps([repr(scene), asdict(walk.numerics)], sort_keys=True)
        words.append(hashlib.sha256(described.encode()).hexdigest()[:8])
    return "-".join(words)
