"""dm_control's Physics of a scene: its named measurements are those of the simulation."""

import numpy as np
import pytest

from analytic import SURFACES, Robot
from mjsim.model.standalone.strips import walking_scene
from mjsim.scene import Scene
from mjsim.simulation.simulation import Simulation

Physics = pytest.importorskip("mjsim.env.physics", exc_type=ImportError).Physics

SCENE = Scene(ground=SURFACES["gelatin"])


def test_measurements_follow_the_simulation_along_a_ramp():
    """Within a thousandth of L: the loop gives flat ends the friction of a side besides."""
    physics, simulation = Physics.of(SCENE), Simulation(walking_scene(SCENE))
    physics.step(nstep=100)
    start = physics.displacement()
    for time in np.arange(1, 401) * 0.005:
        valves = Robot().peak_pressure * SCENE.gait.fractions(np.array([time]))[0]
        physics.set_control(valves)
        physics.step()
        seen = simulation.step(valves)
    length = Robot().length
    assert physics.pressures() == pytest.approx(seen.pressure)
    assert physics.displacement() - start == pytest.approx(seen.left, abs=1e-3 * length)
    ends = physics.ends()
    assert ends[1, 0] - ends[0, 0] == pytest.approx(seen.right - seen.left, abs=1e-3 * length)
    assert physics.contact_lengths()[1] == pytest.approx(seen.contact_right, abs=0.01 * length)
    assert 0.05 < physics.height() / length < 0.15


def test_every_measurement_has_a_name():
    seen = Physics.of(SCENE).observation()
    assert set(seen) == {"ends", "contact_lengths", "pressures", "displacement", "height"}
    assert seen["contact_lengths"] == pytest.approx([Robot().length / 2] * 2)
