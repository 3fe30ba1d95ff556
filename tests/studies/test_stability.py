"""Predicted limits of the time step, and outcomes either side of where methods fail."""

import math
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from analytic import SURFACES
from mjsim.files.command_line import cli
from mjsim.results.status import Status
from mjsim.scene import Numerics, Scene, registry
from mjsim.simulation.simulation import simulate
from studies.accuracy.benchmark_cases import WALK, exact, scene_of
from studies.accuracy.setting import Setting
from studies.stability import __main__ as stability
from studies.stability.limits import at_rest, highest_frequency, predicted_limit
from studies.stability.maps import outcome, robot_outcome, stiffened, walked
from studies.stability.parameters import varied

UNDAMPED = 1e-6  # s; as good as none


def skip_what_mujoco_refuses(body, integrator):
    if (body, integrator[:8]) == ("rod", "implicit") and mujoco.mj_version() >= 4_000_000:
        pytest.skip("MuJoCo 4 takes no rod under implicit and implicitfast")


def measured_limit(integrator, links, damping_time, body="chain"):
    """Largest time step at which a strip free of ground and weight stays finite [s], to 5 %."""
    # Coulomb's: no dry friction on the ends
    scene = Scene(friction="coulomb", ground=SURFACES["gelatin"], body=body)

    def stable(timestep):
        numerics = Setting(body, links, timestep, integrator).numerics()
        model = at_rest(scene, replace(numerics, damping_time=damping_time))
        model.opt.gravity[:] = 0
        off = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_AUTORESET
        model.opt.disableflags |= int(off)
        data = mujoco.MjData(model)
        data.qvel[:] = 1e-6 * np.random.default_rng(1).standard_normal(model.nv)
        start = np.linalg.norm(data.qvel)
        for _ in range(400):
            mujoco.mj_step(model, data)
            if not np.linalg.norm(data.qvel) < 30 * start:
                return False
        return True

    low, high = 1e-7, 0.1
    if stable(high):
        return math.inf
    while high / low > 1.05:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


@pytest.mark.parametrize("integrator", ["Euler", "implicitfast", "implicit", "RK4"])
@pytest.mark.parametrize("damping", [UNDAMPED, Numerics().damping_time])
@pytest.mark.parametrize(("body", "links"), [("chain", 12), ("cable", 12), ("rod", 6)])
def test_a_body_diverges_where_its_highest_mode_is_predicted_to(body, links, integrator, damping):
    skip_what_mujoco_refuses(body, integrator)
    numerics = Numerics(links=links, damping_time=damping).resolved(body, "constant")
    omega = highest_frequency(Scene(body=body), numerics)
    predicted = predicted_limit(integrator, omega, damping, body)
    assert measured_limit(integrator, links, damping, body) == pytest.approx(predicted, rel=0.1)


def test_without_damping_that_is_2_over_omega_max():
    omega = highest_frequency(Scene(), Numerics(links=12).resolved("chain", "constant"))
    assert predicted_limit("Euler", omega, 0.0) == pytest.approx(2 / omega)
    assert measured_limit("Euler", 12, UNDAMPED) == pytest.approx(2 / omega, rel=0.1)


@pytest.mark.parametrize("body", registry.names())
def test_the_discrete_integrator_has_no_limit(body):
    assert measured_limit("discrete", 12, UNDAMPED, body) == math.inf


def test_twice_the_links_have_four_times_the_highest_frequency():
    low, high = (
        highest_frequency(Scene(), Numerics(links=n).resolved("chain", "constant"))
        for n in (12, 24)
    )
    assert high == pytest.approx(4 * low, rel=0.01)


def test_stiffness_raises_frequencies_by_its_root():
    numerics = Numerics(links=12).resolved("chain", "constant")
    soft, stiff = (highest_frequency(stiffened(f), numerics) for f in (1.0, 100.0))
    assert stiff == pytest.approx(10 * soft, rel=1e-6)


FAILED = {"diverged", "toppled"}


@pytest.mark.parametrize(
    ("body", "integrator", "links", "timestep", "expected"),
    [("chain", "discrete", 12, 0.02, {"accurate"}),
     ("chain", "discrete", 6, 0.1, {"accurate", "drifting"}),
     ("chain", "RK4", 12, 0.002, FAILED), ("chain", "Euler", 24, 0.02, FAILED),
     ("chain", "Euler", 12, 0.005, {"drifting", "wrong direction", *FAILED}),
     ("chain", "implicitfast", 12, 0.02, FAILED), ("chain", "implicit", 12, 0.02, FAILED),
     ("cable", "discrete", 12, 0.005, {"accurate", "drifting"}),
     ("cable", "Euler", 12, 0.02, FAILED),
     ("cable", "RK4", 12, 0.002, FAILED),
     ("rod", "discrete", 6, 0.01, {"accurate", "drifting"}),
     ("rod", "discrete", 18, 0.01, {"accurate"}),
     ("rod", "Euler", 12, 0.002, FAILED), ("rod", "implicit", 12, 0.002, FAILED)],
)  # fmt: skip
def test_walks_fail_as_the_map_says(body, integrator, links, timestep, expected):
    skip_what_mujoco_refuses(body, integrator)
    assert walked(body, integrator, links, timestep)["outcome"] in expected


def test_a_walk_that_is_accurate_stays_so_for_20_cycles():
    assert walked("chain", "discrete", 12, 0.02, cycles=20) == {"outcome": "accurate"}


@pytest.mark.parametrize("body", ["chain", "cable"])
def test_a_walk_diverges_where_the_strip_on_its_ends_is_predicted_to(body):
    """Within a factor of 1.5 either way; its light end links are what is fast, and they stand."""
    numerics = Numerics(links=6).resolved(body, "constant")
    omega = highest_frequency(Scene(body=body), numerics, standing=True)
    limit = predicted_limit("RK4", omega, numerics.damping_time, body)
    free = highest_frequency(Scene(body=body), numerics)
    assert limit > 2 * predicted_limit("RK4", free, numerics.damping_time, body)
    below, above = (walked(body, "RK4", 6, round(step, 6)) for step in (limit / 1.5, limit * 1.5))
    assert below["outcome"] in ("accurate", "drifting")
    assert above["outcome"] in ("diverged", "toppled")


def test_a_rod_that_diverges_within_a_step_is_an_outcome_and_no_error():
    """Its vertices are kilometres apart before its ends are seen to leave the ground."""
    skip_what_mujoco_refuses("rod", "implicit")
    assert walked("rod", "implicit", 12, 0.1, 43.29)["outcome"] in ("diverged", "toppled")


def test_what_is_accurate_is_so_by_the_written_bound():
    scene, numerics = scene_of(WALK, "gelatin"), Numerics(links=12)
    value = exact(WALK, "gelatin")
    assert outcome(scene, numerics, value) == "accurate"
    assert outcome(scene, numerics, 1.2 * value) == "drifting"
    assert outcome(scene, numerics, -value) == "wrong direction"
    high = replace(scene, robot=replace(scene.robot, peak_pressure=90e3))
    assert outcome(high, numerics, value) == "toppled"


@pytest.mark.parametrize("integrator", ["Euler", "implicitfast", "RK4"])
def test_a_walk_that_diverges_is_never_called_ok(integrator):
    """Left alone, MuJoCo starts anew from its first state, which looks like a robot at rest."""
    numerics = Setting("chain", 24, 0.05, integrator).numerics()
    assert simulate(Scene(), numerics).status in (Status.DIVERGED, Status.TOPPLED)


def test_a_heavier_robot_stands_at_55_kilopascals_and_not_at_85():
    """Either side of the end of the stable branch, by theory and in MuJoCo."""
    low, high = (robot_outcome(11.44, pressure) for pressure in (55e3, 85e3))
    assert (low["elastica"], low["chain"]) == ("ok", "accurate")
    assert high["elastica"] in ("branch_end", "rolled_up")
    assert high["chain"] == "toppled"


def test_the_paper_s_modes_sink_where_the_robot_is_heavy():
    assert robot_outcome(8.0, 40e3)["sunk"] < 1e-3
    assert robot_outcome(30.0, 40e3)["sunk"] > 0.01


@pytest.mark.parametrize(
    ("parameter", "good", "bad"),
    [("ramp_time", 8.0, 0.5), ("side_angle", 1e-3, 0.1), ("friction_number", 1.5, 0.03)],
)
@pytest.mark.slow
def test_a_parameter_changes_the_answer_beyond_its_range_and_not_within(parameter, good, bad):
    near, far = (abs(varied(parameter, value, "felt")["error"]) for value in (good, bad))
    assert near < 0.02
    assert not far < 0.05


def test_an_unknown_map_gets_one_line(tmp_path, capsys):
    with pytest.raises(SystemExit) as stop:
        stability.main(["--map", "atlas", "--out", str(tmp_path)])
    assert stop.value.code == cli.BAD_INPUT
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


@pytest.mark.slow
def test_a_quick_map_is_made_and_goes_on_where_it_was(tmp_path):
    words = ["--quick", "--map", "robots", "--out", str(tmp_path)]
    assert stability.main(words) == 0
    tables = {path: path.read_text() for path in tmp_path.glob("*.csv")}
    assert len(tables) == 1
    assert stability.main(words) == 0
    assert all(path.read_text() == text for path, text in tables.items())
    assert len(list(tmp_path.glob("*.png"))) == 1
