"""Speed, in one run on one core: `make bench`. Compare within a run, never across machines."""

import mujoco
import numpy as np
import pytest

from analytic import GAITS, Robot, solve_elastica, solve_modes, solve_obstacle
from mjsim.model.builder import compile_model
from mjsim.scene import Numerics, Scene
from mjsim.simulation.simulation import simulate


def test_modes_along_a_gait(benchmark):
    states = np.tile(GAITS["wave"].pressures(200), (20, 1)) * Robot().peak_pressure
    benchmark.extra_info["states"] = len(states)
    benchmark(solve_modes, Robot(), states)


@pytest.mark.parametrize("links", [12, 24, 60, 120])
def test_elastica_along_a_gait(benchmark, links):
    states = GAITS["wave"].pressures(100) * Robot().peak_pressure
    benchmark.extra_info["states"] = len(states)
    benchmark.pedantic(solve_elastica, (Robot(), states, links), rounds=7, warmup_rounds=1)


def test_obstacle_along_a_gait(benchmark):
    states = GAITS["wave"].pressures(100) * Robot().peak_pressure
    benchmark.extra_info["states"] = len(states)
    benchmark.pedantic(solve_obstacle, (Robot(), states), rounds=7, warmup_rounds=1)


@pytest.mark.parametrize("links", [12, 24, 48])
def test_one_cycle_loop_without_assembly(benchmark, links):
    """The loop alone, as the run reports it."""
    result = {}

    def run():
        result["walk"] = simulate(Scene(), Numerics(links=links))
        return result["walk"].wall_time

    benchmark.pedantic(run, rounds=7, warmup_rounds=1)
    walk = result["walk"]
    benchmark.extra_info["realtime_factor"] = (
        len(walk.time) * walk.numerics.timestep / (walk.wall_time)
    )


@pytest.mark.parametrize("links", [12, 24, 48])
def test_bare_steps_of_the_same_model(benchmark, links):
    """Time of as many mj_step as a cycle has, on a strip lying flat."""
    model = compile_model(Scene(), Numerics(links=links).resolved("chain", "constant"))
    data = mujoco.MjData(model)

    def run():
        mujoco.mj_step(model, data, nstep=1050)

    benchmark.pedantic(run, rounds=7, warmup_rounds=1)


def test_assembly_and_compilation(benchmark):
    benchmark(compile_model, Scene(), Numerics().resolved("chain", "constant"))
