"""Simulations that several tests look at, run once, and what a command refuses."""

from dataclasses import replace
from functools import cache

import pytest

from analytic import GAITS, SURFACES, Gait, Robot, Surface
from mjsim import run
from mjsim.io import cli
from mjsim.scene import Numerics, Scene, default_numerics
from mjsim.simulation.measures import Measures, measure
from mjsim.simulation.simulation import simulate
from mjsim.simulation.status import Status
from mjsim.simulation.trajectory import Trajectory


@cache
def walk(
    surface: str | Surface = "felt",
    gait: str = "wave",
    ramp_time: float = 2.0,
    reverse: bool = False,
    cycles: int = 1,
    pressure: float = Robot().peak_pressure,
    links: int = Numerics().links,
    timestep: float | None = None,
    body: str = "planar",
    friction: str = "constant",
    friction_number: float = Scene().friction_number,
    **changes: float | str,
) -> Trajectory:
    stages = GAITS[gait].reversed() if reverse else GAITS[gait]
    scene = Scene(
        robot=replace(Robot(), peak_pressure=pressure),
        gait=Gait(stages.name, stages.stages, ramp_time),
        surface=SURFACES[surface] if isinstance(surface, str) else surface,
        cycles=cycles,
        body=body,
        friction=friction,
        friction_number=friction_number,
    )
    usual = default_numerics(body, friction)
    numerics = replace(usual, links=links, timestep=timestep or usual.timestep, **changes)
    return simulate(scene, numerics)


def measured(*args, **kwargs) -> Measures:
    result = walk(*args, **kwargs)
    assert result.status is Status.OK
    found = measure(result)
    assert found is not None
    return found


def refusal(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """What `mjsim.run` says of bad input, having left with its code after one line."""
    with pytest.raises(SystemExit) as stop:
        run.main(words)
    said = capsys.readouterr().err
    assert stop.value.code == cli.BAD_INPUT
    assert len(said.strip().splitlines()) == 1
    return said
