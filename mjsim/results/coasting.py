"""Robots that nothing brakes: they slide one way, and contacts resist the other way alone.

What a ramp has set moving is then not stopped, however slow the ramp.
"""

from typing import Literal, NamedTuple

import numpy as np

from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS
from analytic.scene.ground import surfaces_of
from analytic.scene.limbs import limbs_of
from analytic.scene.surface import Surface
from mjsim.scene import Scene


class Coasting(NamedTuple):
    """Contacts that nothing brakes one way.

    Attributes:
        contacts: tips, or sides where tips do not resist at all.
        way: of the motion that none of them resists.
    """

    contacts: Literal["tips", "sides"]
    way: Literal["ahead", "back"]

    @property
    def note(self) -> str:
        """Note beside a number."""
        if self.contacts == "tips":
            return f"nothing brakes tips that slide {self.way}: it coasts, at any speed"
        return (f"nothing brakes sides that slide {self.way}, nor tips: it coasts or stands still, "
                "at any speed")  # fmt: skip


def coasting(scene: Scene) -> Coasting | None:
    """Contacts of a robot, all feet switched on, that resist one way alone; None if none do.

    None too of a robot with a tether that drags, which brakes it both ways.
    """
    tethers = [limb.strip.tether for limb in limbs_of(scene.robot)]
    if any(tether and tether.drag for tether in tethers):
        return None
    for surface in surfaces_of(scene.ground):
        for contacts in ("tips", "sides"):
            ahead, back = _strongest(scene, surface, contacts == "tips")
            if ahead and back:
                break
            if ahead or back:
                return Coasting(contacts, "back" if ahead else "ahead")
    return None


def unbraked(scene: Scene) -> str:
    """Why momentum counts however slow the gait is, empty if it does not."""
    if coasts := coasting(scene):
        return f"nothing brakes {coasts.contacts} that slide {coasts.way}"
    if not scene.in_space and scene.strip.tether and scene.strip.tether.resists:
        return "beside the pull of a tether it decides which end slides"
    return ""


def _strongest(scene: Scene, surface: Surface, tips: bool) -> tuple[float, float]:
    """Greatest bounds ahead and back of any tip, or of any underside, under a unit load."""
    bounds = []
    pressures = np.full(len(scene.robot.chambers), scene.robot.peak_pressure)
    for limb in limbs_of(scene.robot):
        grip = Grip(limb.strip, LAWS[scene.friction], scene.robot)
        length = limb.strip.length
        for begin, end in ((0.0, 0.0), (length, length)) if tips else ((0.0, length),):
            bounds.append(grip.both_ways(surface, end - begin, 1.0, (begin, end), pressures))
    ahead, back = np.max(bounds, axis=0).tolist()
    return ahead, back
