"""Task that all environments share: inflate chambers, sense the body, go far ahead.

An action is the pressure of each chamber over the peak, commanded to its valve for a control
period. Observations are such as a robot could measure: the pressures, by sensors at the valves; the
angle by which each segment is bent, by stretch sensors; the inclination of a strip's ends, or pitch
and roll of a trunk, by accelerometers; the length of side contact of a strip's ends, or of each
limb, by electrodes. The place on the ground is none.

What a policy earns shall be what its pressures earn on a finer model, since a policy that learns
looks for the places where they differ. So friction acts wherever the robot touches the ground (at
the ends alone, pressing chambers fully on and off by turns goes one length in 13 s, and most of it
the other way with friction in the middle); chambers fill and vent with a time constant that was
measured (mjsim.scene.valves); an episode ends as the robot topples or is thrown, by the detector of
every simulation; and contacts look ahead along the curved paths of ends that swing, which else hop
with every step (mjsim.simulation.curved_paths).
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic.scene.chain import segment_overlap
from analytic.scene.limbs import limbs_of, rotation
from mjsim.env.settings import Settings
from mjsim.results.status import Status
from mjsim.scene import Resolved, Scene
from mjsim.simulation.observation import Observation
from mjsim.simulation.simulation import Simulation

Array = NDArray[np.float64]

FALL = -1.0  # reward of the step in which the robot topples or is thrown [L]; chosen


def sense(
    scenes: Sequence[Scene],
    numerics: Resolved,
    pressure: Array,
    coordinates: Array,
    contact: Array,
) -> Array:
    """Measurements of strips, a row each, (B, 2 S + 4).

    Args:
        scenes, numerics: of the robots.
        pressure: in the chambers, (B, S) [Pa].
        coordinates: of MuJoCo, (B, nq).
        contact: lengths of side contact of left and right end, (B, 2) [m].

    Returns:
        Pressures over the peak; angles by which segments are bent, arching is positive [rad];
        inclinations of left and right end, rising inwards is positive [rad]; lengths of side
        contact over L.
    """
    peak = np.array([scene.robot.peak_pressure for scene in scenes])
    length = np.array([scene.robot.length for scene in scenes])
    hinges = coordinates[:, 3:]
    bends = np.stack(
        [-turn @ segment_overlap(scene.strip.borders, numerics.links)
         for scene, turn in zip(scenes, hinges, strict=True)]
    )  # fmt: skip
    left = coordinates[:, 2]
    ends = np.stack([left, -(left + hinges.sum(axis=1))], axis=1)
    return np.concatenate(
        [pressure / peak[:, None], bends, ends, contact / length[:, None]], axis=1
    )


def middle(scenes: Sequence[Scene], numerics: Resolved, coordinates: Array) -> Array:
    """Place of the middle between the two ends over L, (B,)."""
    from mjsim.simulation.side_by_side.simulate import planar_nodes

    return np.array(
        [planar_nodes(scene, numerics, row[None])[0, [0, -1], 0].mean() / scene.robot.length
         for scene, row in zip(scenes, coordinates, strict=True)]
    )  # fmt: skip


def commands(scene: Scene, action: ArrayLike) -> Array:
    """Pressures that an action commands to the valves, (S,) [Pa]; it is clipped to [0, 1]."""
    return scene.robot.peak_pressure * np.clip(np.asarray(action, dtype=float), 0.0, 1.0)


class Walker:
    """Robot of a single environment: its simulation, and what that showed last.

    Args:
        scene: whose robot and ground it has.
        settings: of the environment.

    Attributes:
        seen: last observation of the simulation.
        place: of the middle of the strip, or of the trunk, ahead over L.
        reward: of the last action: the distance over L, or FALL.
    """

    def __init__(self, scene: Scene, settings: Settings) -> None:
        self.scene, self.simulation = scene, Simulation(scene, settings.resolved, history=False)
        self._ahead = rotation(limbs_of(scene.robot)[0].angle)[:, 0]
        self.reward = 0.0
        self._look(self.simulation.observe())

    def reset(self) -> None:
        """Lay the robot on its ground again and let it settle."""
        self._look(self.simulation.reset())

    def play(self, action: ArrayLike, steps: int) -> None:
        """Do time steps with an action, fractions of the peak pressure (S,)."""
        begin = self.place
        self._look(self.simulation.play(np.tile(commands(self.scene, action), (steps, 1))))
        self.reward = FALL if self.fallen else self.place - begin

    @property
    def fallen(self) -> bool:
        """True of a robot that stands no more."""
        return self.seen.status not in (Status.OK, Status.UNSETTLED)

    def info(self) -> dict[str, Any]:
        """State of the model, which a robot could not measure, after the last action.

        Returns:
            surface: name of the ground. status: of the simulation. sinking: depth of the deepest
            place under the ground, over L. flying: height of the lowest place over the ground, over
            L; 0 where any touches. unconverged: number of the action's time steps in which MuJoCo's
            solver came to its limit of iterations.
        """
        return {
            "surface": self.scene.ground.name, "status": str(self.seen.status),
            "sinking": max(-self._lowest, 0.0), "flying": max(self._lowest, 0.0),
            "unconverged": self.simulation.unconverged,
        }  # fmt: skip

    def sense(self) -> Array:
        """Measurements of the robot, in the order of Names."""
        if self.scene.in_space:
            return self._sense_limbs()
        contact = np.array([[self.seen.contact_left, self.seen.contact_right]])
        return sense([self.scene], self.simulation.numerics, self.seen.pressure[None],
                     self._coordinates(), contact)[0]  # fmt: skip

    def _sense_limbs(self) -> Array:
        simulation, robot = self.simulation, self.scene.robot
        bends, lengths = simulation.hinges(), simulation.side_contacts()
        parts = [
            -turn @ segment_overlap(limb.strip.borders, simulation.numerics.links)
            for limb, turn in zip(limbs_of(robot), bends, strict=True)
        ]
        pitch_and_roll = simulation.data.qpos[4:6]
        return np.concatenate(
            [self.seen.pressure / robot.peak_pressure, *parts, pitch_and_roll,
             lengths / robot.length]
        )  # fmt: skip

    def _look(self, seen: Observation) -> None:
        nodes, length = self.simulation.nodes(), self.scene.robot.length
        self.seen, self._lowest = seen, float(nodes[..., 2].min()) / length
        self.place = float(nodes[0][[0, -1], :2].mean(axis=0) @ self._ahead) / length

    def _coordinates(self) -> Array:
        return np.array(self.simulation.data.qpos)[None]
