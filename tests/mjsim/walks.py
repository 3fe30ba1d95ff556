"""Simulations that several tests look at, run once, and what a command refuses."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from analytic import GAITS, SURFACES, Elastica, Friction, Gait, Robot, Surface, predict
from mjsim.commands import run
from mjsim.files.command_line import cli
from mjsim.results import prediction
from mjsim.results.measures import Measures, measure
from mjsim.results.status import Status
from mjsim.results.trajectory import Trajectory
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate

# heavier and more curved than the default robot: its stable branch ends at 65 kPa
HEAVIER = Robot(weight_per_length=2.0, chamber_height=4.1e-3)
BENT = Friction(tension=1.0)


@cache
def walk(
    surface: str | Surface = "felt",
    gait: str = "wave",
    ramp_time: float = 2.0,
    reverse: bool = False,
    cycles: int = 1,
    robot: Robot | None = None,
    body: str = "chain",
    friction: str = "constant",
    forces: bool = False,
    **changes: float | str,
) -> Trajectory:
    stages = GAITS[gait].reversed() if reverse else GAITS[gait]
    scene = Scene(
        robot=robot or Robot(),
        gait=replace(stages, ramp_time=ramp_time),
        ground=SURFACES[surface] if isinstance(surface, str) else surface,
        cycles=cycles,
        body=body,
        friction=friction,
    )
    return simulate(scene, Numerics(**changes), forces=forces)


def measured(*args, **kwargs) -> Measures:
    result = walk(*args, **kwargs)
    assert result.status is Status.OK
    numbers = measure(result)
    assert numbers is not None
    return numbers


@cache
def predicted(
    robot: Robot, gait: Gait, ground: Surface, friction: Friction = BENT, links: int = 36
) -> float:
    """Displacement per cycle over L by an elastica that is resolved to a part of a thousandth."""
    walk = predict(robot, gait, ground, Elastica(links), 25, friction=friction)
    return walk.locomotion.per_cycle / robot.length


def went(walk: Trajectory) -> NDArray[np.float64]:
    """Move of a walk in its last cycle, ahead and to the left of its trunk [m]."""
    one, two = walk.ends_of_cycles()[-2:].tolist()
    return walk.moved(one, two)


def turned(walk: Trajectory) -> float:
    """Turn to the left in that cycle [rad]."""
    one, two = walk.ends_of_cycles()[-2:].tolist()
    return float(walk.heading[two] - walk.heading[one])


def coarsen(monkeypatch: pytest.MonkeyPatch, links: int = 18, states: int = 10) -> None:
    """Make the references of records coarse: few links and states."""
    values = {"_LINKS": links, "_LINKS_A_SEGMENT": links // 3, "STATES": states, "LIMB_STATES": 8}
    for name, value in values.items():
        monkeypatch.setattr(prediction, name, value)


def refusal(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Line of `undulator run` on bad input, having left with its code."""
    with pytest.raises(SystemExit) as stop:
        run.main(words)
    said = capsys.readouterr().err
    assert stop.value.code == cli.BAD_INPUT
    assert len(said.strip().splitlines()) == 1
    return said
