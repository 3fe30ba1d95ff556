"""Simulations that several tests look at, run once, and what a command refuses."""

from dataclasses import replace
from functools import cache

import pytest

from analytic import GAITS, SURFACES, Elastica, Friction, Gait, Robot, Surface, predict
from mjsim.commands import run
from mjsim.files import cli
from mjsim.results import limb_record as record_of_limbs
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
    body: str = "planar",
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
    walk = predict(robot, gait, ground, Elastica(links), 25, refinement=16, friction=friction)
    return walk.locomotion.per_cycle / robot.length


def coarsen(
    monkeypatch: pytest.MonkeyPatch, links: int = 18, states: int = 10, parts: int = 4
) -> None:
    """Make the references of records coarse: few links and states."""
    for module, values in (
        (prediction, {"_LINKS": links, "STATES": states, "_PARTS": parts}),
        (record_of_limbs, {"_STATES": 8}),
    ):
        for name, value in values.items():
            monkeypatch.setattr(module, name, value)


def refusal(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """What `undulator run` says of bad input, having left with its code after one line."""
    with pytest.raises(SystemExit) as stop:
        run.main(words)
    said = capsys.readouterr().err
    assert stop.value.code == cli.BAD_INPUT
    assert len(said.strip().splitlines()) == 1
    return said
