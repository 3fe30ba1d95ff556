"""Theory against an independent minimiser on random gaits through low pressures.

    python benchmarks/minimiser/gaits.py [--theory] [--nap] [--feet] [COUNT]

Gaits of three segments that start inflated or pass through pressures of a few per cent: of even
seeds on uniform ground at Phi of 1.5 to 4, of odd ones on two to four patches at Phi of 0.1 to 1.5;
with --nap, seeds from 1000 on, through half the pressure, on uniform ground that resists otherwise
back than ahead, by half the links; with --feet, seeds from 2000 on, likewise on ground that is
round, with two or three feet, some unlike ahead and back, some with a bound of their own, some
switched.
The minimiser (chain.py beside this file) is numpy and scipy alone, of 99 links, and of 198 where
it differs. Adds what is missing of the first COUNT (40) seeds to gaits.csv, a row as it is done,
and prints how many agree within 3 % or 0.0005 L. A row of a seed is made anew by deleting it; with
--theory the theory of all rows is, with its error bar (nan: not made yet).
"""

import csv
import math
import sys
import time
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from chain import NoMinimumError, Walk, walk
from strip import Strip

from mjsim.files.scene_tables.tables import build
from mjsim.results.prediction import HALF, displacement, error_bars, prediction, reference

ROWS = Path(__file__).with_name("gaits.csv")
NAP = 1000  # seeds from here on are of ground with a nap
FEET = 2000  # and from here on of strips with feet
COUNT, COARSE, LINKS, FINER, STATES = 40, 48, 99, 198, 60
RELATIVE, ABSOLUTE = 0.03, 5e-4  # of the distance; over L
LOW = (0.02, 0.05, 0.1)  # of the peak pressure


class Row(NamedTuple):
    """Displacements over L: theory, its error bar, minimiser, and with FINER links if needed."""

    seed: int
    theory: float
    bar: float
    minimiser: float
    finer: float
    flags: str

    @property
    def agrees(self) -> bool:
        return alike(self.theory, self.minimiser) or alike(self.theory, self.finer)


def alike(theory: float, minimiser: float) -> bool:
    return abs(theory - minimiser) <= max(RELATIVE * abs(minimiser), ABSOLUTE)


def tables(seed: int) -> dict[str, Any]:
    """One scene as the tables of a scene file, SI."""
    rng = np.random.default_rng([32, seed])
    stages = rng.choice([0.0, 1.0, *LOW], (int(rng.integers(3, 5)), 3),
                        p=[0.35, 0.35, 0.1, 0.1, 0.1])  # fmt: skip
    if seed >= NAP:
        stages[np.isin(stages, LOW)] = 0.5
        stages[0] = 0.0
        if seed >= FEET:  # which go farther
            stages = rng.choice([0.0, 0.5, 1.0], (4, 3))
            stages[0] = 0.0
    elif not (stages[0].any() or np.isin(stages, LOW).any()):
        stages[0, int(rng.integers(3))] = 1.0
    peak = round(float(rng.uniform(25e3, 48e3)))
    uniform = seed % 2 == 0 or seed >= NAP
    strong = uniform and seed < NAP
    phi = rng.uniform(1.5, 4.0) if strong else rng.uniform(0.1, 1.5)
    unit = float(phi) * Strip().bending(np.zeros(1))[0][0] / Strip().length ** 2
    count = 1 if uniform else int(rng.integers(2, 5))
    area = Strip().width * Strip().length / 3
    patches = []
    places = np.sort(rng.uniform(0.0, 0.15, count - 1))
    for number in range(count):
        tip, side = rng.choice([0.0, 0.3, 0.6, 1.0], 2) * rng.uniform(0.8, 1.2, 2)
        if not tip + side:
            side = 1.0
        patch = {"tip_force": float(tip * unit), "shear_strength": float(side * unit / area)}
        if number:
            patch["from"] = float(round(places[number - 1], 4))
        patches.append(patch)
    if NAP <= seed < FEET:
        backward = float(np.exp(rng.uniform(-1, 1) * np.log(5.0)))
        for key in ("tip_force", "shear_strength"):
            value = patches[0][key] / max(backward, 1.0)
            patches[0][key] = {"ahead": value, "back": backward * value}
    feet = {"feet": _feet(rng, unit)} if seed >= FEET else {}
    closed = [*stages.tolist(), stages[0].tolist()]
    return {
        "robot": {"peak_pressure": float(peak),
                  "weight_per_length": round(float(rng.uniform(0.9, 2.0)), 3), **feet},
        "gait": {"stages": closed, "ramp_time": 8.0},
        "ground": patches[0] if uniform else {"patches": patches},
    }  # fmt: skip


def _feet(rng: np.random.Generator, unit: float) -> list[dict[str, Any]]:
    """Two or three feet as tables, not stronger than a unit [N] by far."""
    edges = [0.0, *np.sort(rng.uniform(0.1, 0.9, 4)).round(3).tolist(), 1.0]
    feet = []
    for begin, end in list(zip(edges[::2], edges[1::2], strict=True))[: int(rng.integers(2, 4))]:
        ahead, ratio = np.exp(rng.uniform(-1, 1, 2) * np.log(3.0)).tolist()
        foot = {"begin": begin, "end": end, "grip": round(ahead, 3)}
        if rng.random() < 0.5:
            foot["grip_back"] = round(ahead * ratio, 3)
        if rng.random() < 0.5:
            foot["hold"] = float(rng.uniform(0.1, 0.5) * unit)
        if rng.random() < 0.5:
            foot["chamber"] = str(rng.choice(["left", "middle", "right"]))
        feet.append(foot)
    return feet


def _foot(table: dict[str, Any]) -> tuple[float, float, float, float, float, int]:
    """Numbers of a foot as the minimiser takes them."""
    chambers = ("left", "middle", "right")
    segment = chambers.index(table["chamber"]) if "chamber" in table else -1
    grips = table["grip"], table.get("grip_back", table["grip"])
    return table["begin"], table["end"], *grips, table.get("hold", 0.0), segment


def by_minimiser(scene: dict[str, Any], links: int = LINKS, states: int = STATES) -> Walk:
    """Walk of the minimiser, of one cycle, as the product measures."""
    patches = scene["ground"].get("patches", [scene["ground"]])
    backward = 1.0
    if isinstance(patches[0]["tip_force"], dict):
        pairs = [patches[0][key] for key in ("tip_force", "shear_strength")]
        backward = max(pair["back"] for pair in pairs) / max(pair["ahead"] for pair in pairs)
        ahead = {k: patches[0][k]["ahead"] for k in ("tip_force", "shear_strength")}
        patches = [ahead]
    strip = Strip(
        back=backward, peak=scene["robot"]["peak_pressure"],
        feet=tuple(map(_foot, scene["robot"].get("feet", []))),
        weight_per_length=scene["robot"]["weight_per_length"],
        borders=tuple(patch["from"] for patch in patches[1:]),
        tips=tuple(patch["tip_force"] for patch in patches),
        shears=tuple(patch["shear_strength"] for patch in patches),
    )  # fmt: skip
    stages = np.array(scene["gait"]["stages"])
    return walk(strip, stages, scene["robot"]["peak_pressure"], states, 1, links)


def theory(scene: dict[str, Any]) -> tuple[float, float, str]:
    """Displacement over L, error bar, flags."""
    built, numerics = build(scene)
    fine = reference(built, numerics)
    bar, _ = error_bars(built, fine, reference(built, numerics, HALF))
    return displacement(built, prediction(built)), bar or math.nan, "+".join(fine.flags)


def row(seed: int) -> Row:
    scene = tables(seed)
    ahead, bar, flags = theory(scene)
    distances = [math.nan, math.nan]
    try:
        for i, links in enumerate((COARSE, LINKS) if seed >= NAP else (LINKS, FINER)):
            distances[i] = by_minimiser(
                scene, links, 2 * links // 3 if seed >= NAP else STATES
            ).by_cycle[-1]
            if alike(ahead, distances[i]):
                break
    except NoMinimumError:
        pass
    return Row(seed, ahead, bar, *distances, flags)


def read() -> dict[int, Row]:
    if not ROWS.is_file():
        return {}
    with ROWS.open(newline="") as file:
        return {
            int(seed): Row(int(seed), *map(float, numbers), flags)
            for seed, *numbers, flags in list(csv.reader(file))[1:]
        }


def write(result: Row) -> None:
    new = not ROWS.is_file()
    with ROWS.open("a", newline="") as file:
        writer = csv.writer(file)
        if new:
            writer.writerow(Row._fields)
        writer.writerow([result.seed, *(f"{value:.6f}" for value in result[1:5]), result.flags])


def main(words: list[str]) -> None:
    counts = [int(word) for word in words if not word.startswith("-")]
    first = FEET if "--feet" in words else NAP if "--nap" in words else 0
    seeds, rows = range(first, first + (counts[0] if counts else COUNT)), read()
    if "--theory" in words:
        for seed, old in rows.items():
            ahead, bar, flags = theory(tables(seed))
            rows[seed] = old._replace(theory=ahead, bar=bar, flags=flags)
        ROWS.unlink()
        for result in rows.values():
            write(result)
    for seed in seeds:
        if seed in rows:
            continue
        begin = time.time()
        rows[seed] = row(seed)
        write(rows[seed])
        print(f"{rows[seed]} {time.time() - begin:.0f} s", flush=True)
    chosen = [rows[seed] for seed in seeds]
    at_once = [result for result in chosen if alike(result.theory, result.minimiser)]
    off = [result for result in chosen if not result.agrees]
    agree = len(seeds) - len(off)
    print(f"{len(at_once)} of {len(seeds)} agree with {LINKS} links, {agree} in all")
    for result in off:
        print(
            f"  seed {result.seed}: {result.theory:+.5f} ± {result.bar:.5f}, minimiser "
            f"{result.minimiser:+.5f}, with finer links {result.finer:+.5f} {result.flags}"
        )


if __name__ == "__main__":
    main(sys.argv[1:])
