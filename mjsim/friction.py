"""The seed's friction law as bounds on what holds the two ends (section 2.2).

Each end is held along x by a dry friction of its own bound, V0 V_t or V0 tau lambda / L_segment,
and the physics lets the weaker one slide. Where both bounds are equal that would leave undecided
who slides: the seed's answer, both alike, is a dry friction on the mean position of the ends, of
bound V0 and in place of both.
"""

from analytic import Surface
from mjsim.config import Scene

# bounds of the friction along x on the left end, on the right end and on their mean position [N],
# and the part of a change of separation that the left end will take up
Hold = tuple[float, float, float, float]


class PaperLaw:
    """Constant bounds at tips, by area on sides, sharing on ties."""

    def __init__(self, scene: Scene) -> None:
        surface: Surface = scene.surface
        self._both = scene.force_scale
        self._tip = scene.force_scale * surface.tip
        self._area = scene.force_scale * surface.area / scene.robot.segment_length

    def hold(self, contact_left: float, contact_right: float) -> Hold:
        """What holds ends with these lengths of side contact, 0 for a tip [m]."""
        left = self._area * contact_left if contact_left else self._tip
        right = self._area * contact_right if contact_right else self._tip
        if left == right:
            return 0.0, 0.0, self._both, 0.5
        return left, right, 0.0, 0.0 if left > right else 1.0
