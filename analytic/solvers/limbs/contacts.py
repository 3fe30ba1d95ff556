"""Friction of the contacts of a tree of limbs: where they resist, and how strongly.

A tip resists by V_t, over its width; limbs that begin at one place share the tip force of an end by
their widths. A side resists by tau times its area, at four points: two of Gauss along it, two
across. Under mu N each resists by its coefficient times its load, a side at four points that stand
for where it is pushed, see analytic.solvers.limbs.contact_points. A foot changes the contact that
it is in at all its points alike.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.friction.dissipation_in_plane import Nap, nap_of
from analytic.friction.grip import Grip, resists_by_speed
from analytic.scene.ground import (
    check_adhesion,
    check_for_limbs,
    durations,
    surfaces_of,
)
from analytic.scene.limbs import AnyRobot
from analytic.scene.robot import GRAVITY
from analytic.scene.surface import Ground, Surface, Way
from analytic.solvers.limbs.contact_search import SHORT, ContactSearch
from analytic.solvers.limbs.contact_state import TETHER, Contact
from analytic.solvers.limbs.kinematics import Tree

Array = NDArray[np.float64]


class Contacts(ContactSearch):
    """Finds the contacts of a tree, and tells how they resist; see ContactSearch.

    Attributes:
        switched: whether chambers switch any foot.
    """

    def __init__(self, tree: Tree, law: str = "constant", all_on_tips: bool = False) -> None:
        super().__init__(tree, law, all_on_tips)
        self._grips = [Grip(limb.strip, self._law, tree.robot) for limb in tree.robot.limbs]
        self.switched = any(grip.switched for grip in self._grips)

    def is_round(self, ground: Ground) -> bool:
        """Tell whether all contacts on a ground resist alike in all directions."""
        return all(grip.is_round(ground) for grip in self._grips)

    def weights(self, contacts: list[Contact]) -> Array:
        """Weights of the nodes in the points of all contacts that resist, (C, P)."""
        limbs = [contact.limb for contact in contacts for _ in contact.at]
        at = [at for contact in contacts for at in contact.at]
        return self._tree.points(limbs, at, [y for contact in contacts for y in contact.aside])

    def resistances(
        self, contacts: list[Contact], ground: Ground, x: Array, speeds: Array | float = 0.0,
        way: Way | None = None, pressures: Any = None,
    ) -> tuple[Array, Array]:  # fmt: skip
        """Bounds [N] and viscous resistances [N s/m] of all these points.

        Args:
            contacts: whose points they are.
            ground: under them.
            x: places of the points, (C,) [m].
            speeds: of their slips, (C,) or one for all [m/s].
            way: of the motion that is resisted, where the ground or a foot has a nap.
            pressures: of the chambers, of no matter without feet that are switched, (S,) [Pa].
        """
        points = [contact for contact in contacts for _ in contact.at]
        speeds = np.broadcast_to(speeds, len(points))
        pairs = [
            self.resistance(
                contact, ground.at(place).against(way) if way else ground.at(place), speed,
                way or "ahead", pressures,
            )
            for contact, place, speed in zip(points, x.tolist(), speeds.tolist(), strict=True)
        ]  # fmt: skip
        bounds, viscous = np.array(pairs).reshape(-1, 2).T * shares(contacts)
        return bounds, viscous

    def friction(
        self, contacts: list[Contact], ground: Ground, x: Array, robot: float, along: float,
        speeds: Array | float = 0.0, pressures: Any = None,
    ) -> tuple[Array, Array, Nap | None]:  # fmt: skip
        """Bounds, viscous resistances and directions of all these points, see resistances.

        Args:
            contacts, ground, x, pressures: see resistances.
            robot, along: directions of the robot and of the ground's +x, in the frame of the slips
                [rad].
            speeds: see resistances.

        Returns:
            No directions where ground and feet resist alike in all of them.
        """
        if self.is_round(ground):
            return *self.resistances(contacts, ground, x, speeds, None, pressures), None
        ahead, back, across = (
            self.resistances(contacts, ground, x, speeds, way, pressures)
            for way in ("ahead", "back", "across")
        )
        axes = axes_of(ground, x.tolist(), robot, along)
        bounds, nap = nap_of(ahead[0], back[0], across[0], axes)
        return bounds, ahead[1], nap

    def strength(self, ground: Ground) -> float:
        """Greatest bound of all limbs together, each on its side or on its tip [N]."""
        robot = self._tree.robot
        loads = [
            (limb.strip.weight_per_length + press) * limb.strip.length
            + GRAVITY * limb.strip.payload_mass
            for limb, press in zip(robot.limbs, self._tree.press.tolist(), strict=True)
        ]
        return max(
            sum(
                self._grips[i].most[0] * max(
                    self._dry(Contact(i, "end", length, (0.0,), (0.0,), load), surface)
                    for length in (0.0, limb.strip.length)
                ) + self._grips[i].most[1]
                for i, (limb, load) in enumerate(zip(robot.limbs, loads, strict=True))
            )
            for surface in _all_ways(ground)
        )  # fmt: skip

    def resistance(
        self, contact: Contact, surface: Surface, speed: float = 0.0, way: Way = "ahead",
        pressures: Any = None,
    ) -> tuple[float, float]:  # fmt: skip
        """Bound of friction [N] and viscous resistance [N s/m] of a contact.

        Args:
            contact: one.
            surface: under it, alike in all directions.
            speed: of its slip [m/s].
            way: of the motion, which feet may resist otherwise.
            pressures: see resistances.
        """
        if contact.part == TETHER:
            return contact.load, 0.0
        width, grip = self._limbs[contact.limb].width, self._grips[contact.limb]
        bound, damping = self._dry(contact, surface), 0.0
        if grip.feet:
            mean, hold, damping = grip.over(way, contact.stretch, pressures)
            bound = mean * bound + hold
        if surface.static_ratio > 1:
            bound *= surface.at_speed(speed)
        return float(bound), float(surface.drag(width, contact.length) + damping)

    def _dry(self, contact: Contact, surface: Surface) -> float:
        """Bound of a contact by the ground alone [N]."""
        limb = self._limbs[contact.limb]
        if 0 < contact.length <= SHORT * limb.length and not self._law.needs_load:
            return 0.0  # no area: what rounding leaves would be the only bound there is
        bound = self._law.bound(surface, limb.width, contact.length, contact.load)
        if not contact.length and not self._law.needs_load:
            bound *= limb.share
        return float(bound)

    def radius(self, contact: Contact) -> float:
        """Mean distance from its middle of a side's area, or load, 0 of a tip or a point [m]."""
        a, b = 0.5 * contact.length, 0.5 * self._limbs[contact.limb].width
        if not a or len(contact.at) == 1:
            return 0.0
        if contact.share:  # lines across
            arms = [abs(at - contact.middle) for at in contact.at]
            lines = [arm * arm / b * math.asinh(b / arm) if arm else 0.0 for arm in arms]
            return 0.5 * sum([
                part * (math.hypot(arm, b) + line)
                for part, arm, line in zip(contact.share, arms, lines, strict=True)
            ])  # fmt: skip
        far = math.hypot(a, b)  # over a rectangle
        halves = a * a / b * math.log((b + far) / a) + b * b / a * math.log((a + far) / b)
        return (far + 0.5 * halves) / 3


def axes_of(ground: Ground, x: list[float], robot: float, along: float) -> Array:
    """Directions of ahead at places, (C, 2), of length 1.

    Args:
        ground: whose naps they are.
        x: places [m].
        robot, along: directions of the robot and of the ground's +x [rad].
    """
    of_robot = [ground.at(place).ahead_is_the_robots for place in x]
    angle = np.where(np.array(of_robot, dtype=bool), robot, along)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _all_ways(ground: Ground) -> list[Surface]:
    """Surfaces of a ground, one for each way that it resists."""
    return [
        surface.against(way) for surface in surfaces_of(ground)
        for way in ("ahead", "back", "across")
    ]  # fmt: skip


def shares(contacts: list[Contact]) -> Array:
    """Part of each point in its contact, (C,): a viscosity that is equal is so for contacts."""
    return np.array([part for contact in contacts for part in contact.shares])


def spans_of(robot: AnyRobot, ground: Ground, times: Array | None, states: int) -> Array:
    """Durations of the increments between states, (B - 1,) [s]; of 1 s each without times.

    Raises:
        ValueError: the ground or a foot resists by speed and no times are given, or it changes
            along x and is adhesive.
    """
    check_for_limbs(ground)
    check_adhesion(ground)
    if times is None and resists_by_speed(robot, ground):
        raise ValueError(
            "times of the shapes must be given where ground or a foot resists by speed, got None "
            f"on {ground.name!r}"
        )
    return durations(np.arange(float(states)) if times is None else times)
