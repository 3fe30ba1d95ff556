"""Friction of a strip before each step, and which end slides.

Two ways in MuJoCo for the laws of analytic.friction.laws. `BoundedEnds`: each end is anchored along
x by a dry friction of its own bound, on the neutral line, so that it has no lever arm and does not
creep; the physics lets the weaker end slide. Where both bounds are equal that would leave it to
momentum which one slides: the rule of [Majidi13], both alike, is one more dry friction, on the mean
position of the ends. `mjsim.friction.between_ends` does so at every contact. `ContactFriction`:
Coulomb friction at every pad, by MuJoCo's own contacts.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence

import mujoco

from analytic.friction.grip import Grip
from analytic.friction.laws import LAWS, slip_fraction
from analytic.scene.chain import node_positions
from analytic.scene.ground import depends_on_speed, over
from analytic.scene.surface import Surface
from mjsim.friction.contact_length import ContactForces
from mjsim.friction.lean import Lean
from mjsim.model.bodies.parts import PREFIX, TENDONS, contact_softness, tendon_names, tie_force
from mjsim.model.pads import pads_by_node
from mjsim.scene import Resolved, Scene

_TIPS = (0.0, 0.0)  # side contact of two tips
_UNLOADED = (0.0, 0.0)  # what a law gets that needs no load
_ROUNDING = 1e-12  # of bounds that are alike


class StripFriction(ABC):
    """A law at work on a compiled strip: contact lengths of the ends, and which of them moves.

    Attributes:
        contact_left, contact_right: lengths of side contact, 0 for a tip [m].
        left_slip: part of the next change of separation that the left end takes up; NaN where more
            than the two ends share the motion.
        drift: speed of what friction should have anchored in the last step [m/s], where left_slip
            does not tell what that is; else NaN.
        grip: of the strip and its feet.
        pressures: in the chambers in the next step [Pa], where feet are switched by them.
    """

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        self.grip = Grip(scene.strip, LAWS[scene.friction])
        self.pressures: Sequence[float] = ()
        self.contact_left = self.contact_right = 0.0
        self.left_slip, self.drift = 0.5, float("nan")
        self._forces = ContactForces(scene, numerics, model, data)
        self._flat = numerics.side_angle
        self._left, self._right, self._both = (model.tendon(PREFIX + n).id for n in TENDONS)
        self._rate, self._place = data.ten_velocity, data.ten_length
        self._pads = pads_by_node(model)[[0, -1]]
        self._at, self._slip = self._place.item(self._right), 0.0

    @abstractmethod
    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """Read the contacts and set what resists in the next step.

        Args:
            slopes: of the two ends, positive where the strip rises inwards [rad].
            left, right: whether these ends may lie on their side, by their pressure.
        """

    def after_step(self, dt: float) -> float:
        """Displacement towards +x of an anchored place by the order of the step alone [m].

        A place is a function of angles that turn at a constant rate in a step, and the step's
        friction made that place's velocity vanish at its end. What it moved beyond dt times its
        velocity is the integrator's, and taking it off keeps an anchor where it is. The left end's
        place is a coordinate, exact in every step.
        """
        excess, before, at = 0.0, self._at, self._place.item(self._right)
        if self._slip:
            excess = self._slip * (dt * self._rate.item(self._right) - (at - before))
        self._at, self._slip = at - excess, self.left_slip
        return excess

    def _look(
        self, slopes: tuple[float, float], left: bool, right: bool
    ) -> tuple[tuple[bool, bool], tuple[float, float]]:
        """Tell whether each end lies on its side, and over what length [m]."""
        sides = left, right = self._on_side(slopes, left, right)
        return sides, self._forces.lengths(left, right) if left or right else _TIPS

    def _on_side(self, slopes: tuple[float, float], left: bool, right: bool) -> tuple[bool, bool]:
        """Tell whether each end lies on its side: it may, and is as good as flat."""
        return left and slopes[0] <= self._flat, right and slopes[1] <= self._flat

    def _see_which_end_moves(self) -> None:
        left, right = abs(self._rate.item(self._left)), abs(self._rate.item(self._right))
        self.left_slip = 1.0 if left > right else 0.0


class BoundedFriction(StripFriction):
    """Bounds by a law, and softer ground under steep ends."""

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        self._law, self._ground, self._strip = LAWS[scene.friction], scene.ground, scene.strip
        self._nodes: dict[int, float] = {self._left: 0.0, self._right: scene.strip.length}
        self._surface = scene.ground if isinstance(scene.ground, Surface) else None
        self._level, self._tie = scene.slope == 0, tie_force(scene, numerics)
        self._softness, self._bounds = model.geom_solref, model.tendon_frictionloss
        self._drag, self._by_speed = model.tendon_damping, depends_on_speed(scene.ground)
        self._lean = None if self.grip.is_round(scene.ground) else Lean(model)
        self._stiff = contact_softness(scene, numerics)[0][0]
        self._soft = numerics.steep_contact_time * numerics.timestep
        self._steep_angle, self._steep = numerics.steep_angle, (False, False)
        self._far = float(model.site_pos[model.site(f"{PREFIX}far").id][0])

    def _soften_if_steep(self, slopes: tuple[float, float]) -> None:
        steep = slopes[0] > self._steep_angle, slopes[1] > self._steep_angle
        if steep != self._steep:
            self._steep = steep
            for pads, is_steep in zip(self._pads, steep, strict=True):
                self._softness[pads, 0] = self._soft if is_steep else self._stiff

    def _bound(self, tendon: int, contact: float, load: float, inward: float) -> float:
        """Bound of a contact, its mean ahead and back; sets by how much they differ and viscosity.

        Args:
            tendon: that ends there.
            contact: its length, 0 for a tip [m].
            load: normal force [N].
            inward: part of the length that lies beyond the tendon's end: 1, 1/2 or 0.
        """
        surface, outward = self._surface, (1.0 - inward) * contact
        if surface is None:
            begin = self._x_of(tendon) - outward
            surface = over(self._ground, begin, begin + contact)
        width, lean = self._strip.width, 0.0
        if self.grip.feet or self._lean:
            node = self._nodes[tendon]
            stretch = node - outward, node + inward * contact
            ahead, back = self.grip.both_ways(surface, contact, load, stretch, self.pressures)
            bound, lean = 0.5 * (ahead + back), 0.5 * (back - ahead)
        else:
            bound = self._law.bound(surface, width, contact, load)
        if self._by_speed:
            factor = surface.at_speed(self._rate_of(tendon))
            bound, lean = bound * factor, lean * factor
            self._drag[tendon] = surface.drag(width, contact)
        if self._lean:
            self._lean.set(tendon, lean)
        return float(bound)

    def _x_of(self, tendon: int) -> float:
        """Place where a tendon ends, in the step just done [m]."""
        return self._place.item(tendon) + self._far

    def _rate_of(self, tendon: int) -> float:
        """Speed of that place [m/s]."""
        return self._rate.item(tendon)


class BoundedEnds(BoundedFriction):
    """Bounds of the friction along x at the two ends, whatever law gives them.

    On a slope the weight decides between equal bounds, and which end slides is seen as it moves.
    """

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        self._always = bool(
            self._law.needs_load or self._surface is None or self._by_speed or self._lean
            or self.grip.switched
        )  # fmt: skip
        self._contacts, self._tied = (-1.0, -1.0), False

    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """See StripFriction.before_step."""
        _, contacts = self._look(slopes, left, right)
        self._soften_if_steep(slopes)
        if contacts != self._contacts or self._always:
            self._contacts = self.contact_left, self.contact_right = contacts
            self._set_bounds(contacts)
        if not self._level or self._by_speed or (self._lean and not self._tied):
            self._see_which_end_moves()

    def _set_bounds(self, contacts: tuple[float, float]) -> None:
        load_left, load_right = self._forces.loads() if self._law.needs_load else _UNLOADED
        left = self._bound(self._left, contacts[0], load_left, 1.0)
        right = self._bound(self._right, contacts[1], load_right, 0.0)
        equal = self._tied = self._alike(left, right) and self._level
        self.left_slip = 0.5 if equal else slip_fraction(left, right)
        if self._by_speed:
            equal = equal and not (self._drag[self._left] or self._drag[self._right])
        self._bounds[self._left : self._both + 1] = left, right, self._tie if equal else 0.0

    def _alike(self, left: float, right: float) -> bool:
        """Tell whether both ends resist alike the way that the separation changes."""
        if not self._lean:
            return left == right
        lean = self._lean.of(self._left) + self._lean.of(self._right)
        grows = self._rate.item(self._right) > self._rate.item(self._left)
        return math.isclose(left + lean if grows else left - lean, right, rel_tol=_ROUNDING)


class ContactFriction(StripFriction):
    """Coulomb friction of the pads.

    The outermost ones have the coefficient of a tip, or of a side while the end lies on it; the
    others that of a side. On ground that changes along x each has that of its place; on ground that
    resists otherwise back than ahead the mean of both, and a force by its load besides. What feet
    hold by whatever the load is dry friction of the ends' tendons.
    """

    def __init__(
        self, scene: Scene, numerics: Resolved, model: mujoco.MjModel, data: mujoco.MjData
    ) -> None:
        super().__init__(scene, numerics, model, data)
        self._ground, self._friction = scene.ground, model.geom_friction
        self._uniform = isinstance(scene.ground, Surface) and not self.grip.feet
        self._x = data.geom_xpos[:, 0]
        pads = pads_by_node(model)
        self._inner = pads[1:-1].ravel()
        places = node_positions(scene.strip, numerics.links).tolist()
        self._places = {
            pad: place for row, place in zip(pads.tolist(), places, strict=True) for pad in row
        }
        self._sides: tuple[bool, bool] | None = (False, False)
        self._length, self._bounds = scene.strip.length, model.tendon_frictionloss
        self._lean = None
        if not self.grip.is_round(scene.ground):
            self._lean, self._sides = Lean(model), None
            names = tendon_names(numerics.links + 2)
            self._node_tendons = [model.tendon(PREFIX + name).id for name in names]
            self._node_pads = pads[:, 0].tolist()

    def before_step(self, slopes: tuple[float, float], left: bool, right: bool) -> None:
        """See StripFriction.before_step."""
        sides, (self.contact_left, self.contact_right) = self._look(slopes, left, right)
        if sides != self._sides or not self._uniform:
            self._sides = sides
            self._set_friction(sides)
        if self._lean:
            self._lean_by_load(sides)
        if self.grip.holds:
            whole = self._length
            self._bounds[self._left] = self._hold(0.0, self.contact_left)
            self._bounds[self._right] = self._hold(whole - self.contact_right, whole)
        self._see_which_end_moves()

    def _hold(self, begin: float, end: float) -> float:
        """Bound that feet hold a contact by, whatever its load, between two arclengths [N]."""
        return float(self.grip.over("ahead", (begin, end), self.pressures)[1])

    def _set_friction(self, sides: tuple[bool, bool]) -> None:
        for pads, on_side in zip(self._pads, sides, strict=True):
            ahead, back = self._coefficients(int(pads[0]), on_side)
            self._friction[pads, 0] = 0.5 * (ahead + back)
        if not self._uniform or self._lean:
            for pad in self._inner.tolist():
                ahead, back = self._coefficients(pad, True)
                self._friction[pad, 0] = 0.5 * (ahead + back)

    def _lean_by_load(self, sides: tuple[bool, bool]) -> None:
        """Set how much more each node resists back than ahead, by its load in the step before."""
        assert self._lean
        force, _ = self._forces.by_node()
        right_node = len(force) - 1
        on_side = {0: sides[0], right_node: sides[1]}
        for node, (push, tendon) in enumerate(zip(force, self._node_tendons, strict=True)):
            half = 0.0
            if push > 0.0:
                ahead, back = self._coefficients(self._node_pads[node], on_side.get(node, True))
                half = 0.5 * push * (back - ahead)
            self._lean.set(tendon, half)

    def _coefficients(self, pad: int, on_side: bool) -> tuple[float, float]:
        """Coefficients of friction of a pad, on a side or a tip, ahead and back."""
        surface = self._ground.at(self._x.item(pad))
        name = "friction" if on_side else "tip_friction"
        ahead = back = float(getattr(surface, name))
        if not surface.is_round:
            back = surface.resistance(f"{name}_back")
        if self.grip.feet:
            at = self._places[pad], self._places[pad]
            ahead *= self.grip.over("ahead", at, self.pressures)[0]
            back *= self.grip.over("back", at, self.pressures)[0]
        return ahead, back
