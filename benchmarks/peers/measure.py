"""Measure the peers on the cases of the chart, and append what was found to its rows.

All have the same load, rigidity, rest curvature, gait and friction. Settling: the first element is
centred on the wall. Walking: Coulomb's law, with the links of our own chain where links are rigid.
"""

import argparse
import math
import sys
from dataclasses import replace
from importlib import import_module, metadata
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1])]

from mjsim.results.provenance import machine, origin  # noqa: E402
from studies.accuracy import benchmark_cases, heavy_cantilever  # noqa: E402
from studies.accuracy.rows import MEASURED, append, read  # noqa: E402
from studies.accuracy.setting import Setting  # noqa: E402

FAR = 0.1  # over L: of a tip from its place, or of an end from the ground
GROUND = "gelatin"
GRIDS = {  # module: links and time steps of settling, and of walking
    "drake_chain": (((6, 12, 24, 48), (0.05, 0.02, 0.01, 0.005, 0.002)),
                    ((6, 12, 24), (0.02, 0.01, 0.005, 0.002, 0.001))),
    "cosserat_rod": (((6, 12, 24, 48), (1e-4, 5e-5, 2e-5)),
                     ((6, 12, 18, 24), (1e-4, 7e-5, 5e-5))),
    "bullet_chain": (((6, 12), (2e-3, 5e-4, 1e-4)), ((6, 12), (1e-3, 2e-4))),
}  # fmt: skip
NAMES = {"drake_chain": "Drake", "cosserat_rod": "PyElastica", "bullet_chain": "PyBullet"}


def rows(seen):
    """A row for each setting that is not yet there."""
    for name, grids in GRIDS.items():
        peer = import_module(name)
        made = f"{peer.PACKAGE}={metadata.version(peer.PACKAGE)} numpy={np.__version__}"
        cases = (
            (heavy_cantilever.CASE, heavy_cantilever.TIP, settled),
            (benchmark_cases.COULOMB, GROUND, walked),
        )
        for (case, scene, run), (links, timesteps) in zip(cases, grids, strict=True):
            for n in links:
                for timestep in timesteps:
                    setting = Setting(NAMES[name], n, timestep, peer.INTEGRATOR)
                    if (case, scene, setting) in seen:
                        continue
                    row = run(peer, setting)
                    print(case, row.method, n, timestep, f"{row.value:.4g}",
                          f"{row.error:.2g}", f"{row.cost:.3g}", row.status,
                          flush=True)  # fmt: skip
                    commit = origin()["commit"] or ""
                    yield replace(row, machine=machine(), versions=made, commit=commit)


def settled(peer, setting):
    """A tip that is nowhere, or not near where gravity takes it, is no result."""
    tip, timing = peer.settle(setting.links, setting.timestep)
    status = "ok" if math.dist(tip, heavy_cantilever.exact()) < FAR else "drifting"
    if not (np.isfinite(tip).all() and np.abs(tip).sum() < 2):
        status = "diverged"
    return heavy_cantilever.settled(setting, tip, timing, status)


def walked(peer, setting):
    """A strip that is nowhere, or has an end in the air, does not walk."""
    scene = benchmark_cases.scene_of(benchmark_cases.COULOMB, GROUND)
    walk, timing = peer.walk(scene, setting.links, setting.timestep)
    status = "ok" if walk.height < FAR else "toppled"
    if not (math.isfinite(walk.displacement) and math.isfinite(walk.height)):
        status = "diverged"
    return benchmark_cases.walked(
        benchmark_cases.COULOMB, GROUND, setting, walk.displacement, timing, status
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", type=Path, default=MEASURED, help="the chart's table")
    path = parser.parse_args().rows
    for _ in append(rows({row.key for row in read(path)}), path):
        pass
