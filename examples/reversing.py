"""From felt onto gelatin with a controller that feels only how far each cycle went.

    python examples/reversing.py [FOLDER]       # with a figure and a video in it

Backwards a gait goes as far back as it goes forward, also across the seam: where the one stalls the
other does. So a third gait, the pulse, carries the robot over before the reversed one takes it on.
"""

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from imageio_ffmpeg import get_ffmpeg_exe
from matplotlib.figure import Figure

from mjsim import SURFACES, Numerics, Patches, Robot, Scene, Simulation
from studies.control.cycles import Cycles, stripes
from studies.control.reversing import REPERTOIRE, Reversing

FELT, GELATIN = SURFACES["felt"], SURFACES["gelatin"]
SEAM, CYCLES, NOISE = 1.05, 120, 0.01  # L, and of the sensor a cycle over L
NUMERICS = Numerics(links=12, timestep=0.01)
COLOURS = ("#264653", "#2a9d8f", "#d1495b", "#2a9d8f")


def main(folder: Path | None = None, cycles: int = CYCLES) -> dict[str, Any]:
    robot = Robot()
    ground = Patches("felt-gelatin", (SEAM * robot.length,), (FELT, GELATIN))
    theory = Cycles(robot, ground)
    tracks = {
        "wave alone": theory.without(cycles),
        "controller": theory.reversing(cycles),
        "controller, noise 0.01 L": theory.reversing(cycles, NOISE, seed=1),
        "with the map": theory.knowing(cycles),
    }
    scene = Scene(robot, ground=ground, cycles=cycles)
    alone = Simulation(scene, NUMERICS).run()
    policy = Reversing(robot, NUMERICS.timestep)
    walk = Simulation(scene, NUMERICS).run(policy)
    went = {name: float(track.left[-1]) / robot.length for name, track in tracks.items()}
    went |= {f"MuJoCo, {name}": float(w.line[-1, 0, 0]) / robot.length
             for name, w in (("wave alone", alone), ("controller", walk))}  # fmt: skip
    for name, place in went.items():
        print(f"{name:<26} left end after {cycles} cycles at {place:+.3f} L")
    names = [REPERTOIRE[i].name for i in policy.chosen[:cycles]]
    print("gaits in MuJoCo:", ", ".join(f"{names.count(n)} {n}" for n in dict.fromkeys(names)))
    if folder:
        figure = Figure(figsize=(11, 4.2), layout="constrained", dpi=100)
        left, right = figure.subplots(1, 2)
        _draw_tracks(left, tracks, {"wave alone": alone, "controller": walk}, robot, policy)
        _draw_stripes(right, theory)
        figure.savefig(folder / "reversing.png")
        _film([alone, walk], policy, folder / "reversing.mp4")
    return went


def _draw_tracks(axes: Any, tracks: Any, walks: Any, robot: Robot, policy: Any) -> None:
    length, cycles = robot.length, len(tracks["controller"].chosen)
    axes.axhspan(SEAM, 3, color="#e9c46a", alpha=0.4, lw=0)
    axes.axhspan(-1, SEAM, color="#8ab17d", alpha=0.3, lw=0)
    for (name, track), style in zip(tracks.items(), (":", "--", "-.", "-"), strict=True):
        axes.plot(track.left / length + 1, style, color="0.35", lw=1, label=f"theory: {name}")
    time = walks["controller"].time / walks["controller"].scene.gait.period
    alone, x = (walks[name].line[:, -1, 0] / length for name in ("wave alone", "controller"))
    axes.plot(time, alone, color="0.7", lw=1, label="MuJoCo: wave alone")
    axes.plot([], [], color=COLOURS[2], label="MuJoCo: controller, by gait")
    chosen = np.array(policy.chosen[:cycles])
    for cycle, choice in enumerate(chosen.tolist()):
        part = (time >= cycle) & (time <= cycle + 1)
        axes.plot(time[part], x[part], color=COLOURS[choice], lw=1.5)
    names = np.array([REPERTOIRE[choice].name for choice in chosen])
    for name in dict.fromkeys(names.tolist()):
        middle = float(np.median(np.flatnonzero(names == name)))
        place = middle, float(x[np.searchsorted(time, middle)])
        colour = COLOURS[chosen[names == name][0]]
        axes.annotate(name, place, xytext=(8, -14), textcoords="offset points", color=colour,
                      fontsize=8)  # fmt: skip
    axes.set(xlabel="cycles", ylabel="place of the right end [L]", ylim=(0.65, 2.0),
             xlim=(0, cycles))  # fmt: skip
    for name, place in (("gelatin", SEAM + 0.09), ("felt", SEAM - 0.35)):
        axes.text(0.99 * cycles, place, name, ha="right", fontsize=9)
    axes.set_title("The controller crosses from felt to gelatin; the wave alone stalls", fontsize=9)
    axes.legend(fontsize=7, loc="upper left")


def _draw_stripes(axes: Any, theory: Cycles) -> None:
    robot, cycles = theory.robot, 80
    widths = np.array([0.5, 0.75, 1.0, 1.5, 2.0, 3.0])
    speeds: dict[str, list[float]] = {"with the map": [], "controller": [], "noise 0.01 L": []}
    for width in widths:
        theory.ground = stripes(FELT, GELATIN, width * robot.length, 5 * robot.length)
        for name, track in (
            ("with the map", theory.knowing(cycles)),
            ("controller", theory.reversing(cycles)),
            ("noise 0.01 L", theory.reversing(cycles, NOISE, seed=1)),
        ):
            speeds[name].append(float(track.left[-1]) / robot.length / cycles)
    for name, style in zip(speeds, ("-", "--", "-."), strict=True):
        axes.plot(widths, speeds[name], f"o{style}", label=name)
        print(f"{name:<14}", ", ".join(f"{w:g} L {s:+.4f}" for w, s in
                                       zip(widths, speeds[name], strict=True)))  # fmt: skip
    axes.set(xlabel="width of the stripes [L]", ylabel=f"mean of {cycles} cycles [L per cycle]",
             ylim=(-0.002, 0.036))  # fmt: skip
    axes.axhline(0.0336, color="0.7", lw=0.8)
    axes.text(0.5, 0.0336, "one ground, without stripes", va="bottom", fontsize=8, color="0.4")
    axes.set_title("Stripes of felt and gelatin: wide ones cost less (theory)", fontsize=9)
    axes.legend(fontsize=8)


def _film(walks: Any, policy: Reversing, path: Path) -> None:
    """The wave alone above, the controller below, with the gait that it plays."""
    from mjsim.pictures import gl
    from mjsim.pictures.recording import film

    if not gl.use_backend():
        raise SystemExit(gl.HELP)
    names, period = [REPERTOIRE[i].name for i in policy.chosen], walks[1].scene.gait.period
    cycle = np.clip(walks[1].time // period, 0, len(names) - 1).astype(int)
    with tempfile.TemporaryDirectory() as there:
        large, *single = (Path(there) / f"{name}.mp4" for name in ("large", 0, 1))
        film(walks, single, large, [None, [names[i] for i in cycle]])
        small = ["-y", "-i", str(large), "-vf", "scale=640:-2", "-crf", "31", "-preset", "slow"]
        subprocess.run([get_ffmpeg_exe(), "-loglevel", "error", *small, str(path)], check=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
