"""A gecko on two held feet, by a minimiser that shares no code with it and by its symmetries."""

import numpy as np
import pytest
from scipy.optimize import minimize

from zoo.geckobot_gaits import in_mujoco, model, posture
from zoo.geckobot_gaits.posture import Gecko, free, stepped

HELD = 1, 2  # front right, rear left
GRIP = 4.0


def line(turns):
    """Nodes and last heading from a front right foot at 0, whose leg points along x, to the other.

    Chains of straight pieces: back along the leg, along the torso, out along the rear left leg.
    """
    heading, at, nodes = np.pi, 0j, [0j]
    for limb, (length, corner) in enumerate(((9.1, 0), (10.3, np.pi / 2), (9.1, -np.pi / 2))):
        heading += corner
        for turn in turns[limb]:
            heading += 0.5 * turn
            at += length / len(turns[limb]) * np.exp(1j * heading)
            heading += 0.5 * turn
            nodes.append(at)
    return np.array(nodes), heading


def test_a_step_is_one_of_least_energy(monkeypatch):
    pieces = 5
    monkeypatch.setattr(posture, "ARCS", pieces)
    before, after = (np.radians([[*row]]) for row in
                     ([77.5, 22.5, 77.5, 22.5, -55], [27.5, 72.5, 27.5, 72.5, 45]))  # fmt: skip
    of = Gecko(9.1, 10.3, np.array([GRIP]))
    start = free(of, before)
    found = stepped(of, start, HELD, after)
    angles = np.array([-after[0, 1], after[0, 4], after[0, 2]])  # the leg is walked backwards
    rest = np.repeat(angles[:, None] / pieces, pieces, axis=1)
    apart = (start.feet[0, 2] - start.feet[0, 1]) * np.exp(-1j * start.tips[0, 1])
    tip = start.tips[0, 2] - start.tips[0, 1]
    stiff = pieces * np.array([1.0, 9.1 / 10.3, 1.0])[:, None]

    def shape(bent):
        nodes, heading = line(bent[1:].reshape(3, pieces))
        return nodes * np.exp(1j * bent[0]), heading + bent[0]

    def energy(bent):
        cup = np.angle(np.exp(1j * (shape(bent)[1] - tip)))
        off = bent[1:].reshape(3, pieces) - rest
        return 0.5 * (stiff * off**2).sum() + 0.5 * GRIP * (bent[0] ** 2 + cup**2)

    def gap(bent):
        left = shape(bent)[0][-1] - apart
        return [left.real, left.imag]

    least = minimize(energy, np.concatenate([[0.0], rest.ravel()]), method="SLSQP",
                     constraints={"type": "eq", "fun": gap},
                     options={"maxiter": 300, "ftol": 1e-10})  # fmt: skip
    assert least.success
    front = start.feet[0, 1] + np.exp(1j * start.tips[0, 1]) * shape(least.x)[0][pieces]
    assert abs(found.front[0] - front) < 5e-3  # of 10 cm
    assert found.tips[0, 1] - start.tips[0, 1] == pytest.approx(least.x[0], abs=1e-3)


def test_held_feet_stay_and_others_keep_their_free_shapes():
    of = Gecko(9.1, 10.3, np.array([GRIP]))
    asked = np.radians([[30.0, 70, 30, 70, 40]])
    start = free(of, np.radians([[80.0, 20, 80, 20, -50]]))
    found = stepped(of, start, HELD, asked)
    assert found.feet[:, HELD] == pytest.approx(start.feet[:, HELD])
    leg = 9.1 / asked[0, 0] * (np.exp(1j * asked[0, 0]) - 1)  # chord of an arc
    assert abs(found.feet[0, 0] - found.front[0]) == pytest.approx(abs(leg), abs=2e-3)


def test_steering_the_other_way_walks_the_mirror_image():
    left, right = model.cycle(GRIP, 60.0, np.array([-0.3, 0.3])).turn
    assert left == pytest.approx(-right, abs=0.02)  # they begin on unlike diagonals
    straight = model.cycle(np.array([1.0, 30.0]), 60.0, 0.0)
    assert straight.turn == pytest.approx([0, 0], abs=1e-6)
    assert straight.far[0] == pytest.approx(straight.far[1])


def test_more_arcs_change_turns_by_less_than_they_differ_from_mirror_images(monkeypatch):
    one = model.cycle(8.0, 70.0, -0.5).turn
    monkeypatch.setattr(posture, "ARCS", 20)
    assert model.cycle(8.0, 70.0, -0.5).turn == pytest.approx(one, abs=0.3)


def test_angles_are_those_of_the_law_up_to_the_largest_pressure():
    assert np.degrees(model.asked(np.array([-50.0]), np.array([-0.1]))) == pytest.approx(
        np.array([[77.5, 22.5, 77.5, 22.5, -55]])
    )
    most = np.degrees(model.asked(np.array([90.0]), np.array([0.5])))
    assert most == pytest.approx(np.array([[22.5, 157.5, 22.5, 135.2, 104.4]]))


def test_mujoco_walks_as_the_elastica_has_it():
    walked, found = in_mujoco.walk(8.0, 70.0, 0.3), model.cycle(8.0, 70.0, 0.3)
    assert walked.turn == pytest.approx(found.turn, abs=0.3)
    assert walked.far == pytest.approx(found.far, rel=0.01)
