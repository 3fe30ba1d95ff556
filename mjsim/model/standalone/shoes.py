"""Shoes that carry the constant bounds of [Majidi13] by MuJoCo's own friction, without any code.

Friction by load gives a constant bound where the load is that of a shoe: a body of next to no mass
that slides along x with an end of the strip and is pressed on the ground by springs and by the
chambers' own actuators. Each end has one for its side and one for its tip. Which of them touches,
and how hard it is pressed, is decided by one number, the signed length of the end's side contact,

    l(p) = l_0 - sum_j l_j p_j / p,

an affine function of the pressures, nearest to the contact length of the elastica along the scene's
gait. The side's shoe carries tau q l / mu while l is above 0, the tip's V_t / mu as soon as l is
below 0 by about a link, or the end's own chamber is inflated. Where the bounds of both ends
are alike a weak dry friction on the mean of the two ends decides, as vanishing friction does.
"""

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from analytic.friction.contact_length import PASSIVE
from analytic.prediction import Prediction, predict
from analytic.scene import pneunet
from analytic.scene.ground import depends_on_speed
from analytic.scene.surface import Surface
from analytic.solvers.models import Elastica
from mjsim.model.bodies.parts import ORIGIN, PREFIX, TENDONS, softness_with_friction
from mjsim.scene import Resolved, Scene

Array = NDArray[np.float64]

ENDS = TENDONS[:2]
_MU = 0.03  # of the shoes; more lifts them as they slide, less needs more load; chosen
_IMPRATIO = 2500.0  # shoes creep by its inverse; chosen
_TRAVEL = 0.02  # m; of the springs that carry a shoe at rest; chosen
_RADIUS = 1e-3  # m; of a shoe; chosen
# of the robot's mass; kg m^2. MuJoCo scales the stiffness of constraints by mass without armature,
# which smooths what sliding does to the load of so light a shoe; chosen
_MASS, _INERTIA, _ARMATURE = 4e-5, 1e-12, 4e-3
_DAMPING = 0.03  # of the springs, over critical; chosen
_TAKES_OVER = 1 / 42  # of L: the change of l in which a tip is loaded, about a link; chosen
_TIE = 0.03  # of the strongest bound, that of the friction on the mean of the ends; chosen
_LINKS, _STATES = 60, 12  # of the elastica, and its states in a ramp; see mjsim.results.prediction
_NEAR = 0.02  # of L, within which a fit of l sees where it decides who slides; chosen
_FLAT = 0.02  # of the peak: with less in all chambers the whole strip lies flat; chosen
_REGULAR = 1e-9  # of the step between the gait's states, within which a state is one of them
_ROUNDS = 20  # of a fit at most


def refusal(scene: Scene) -> str | None:
    """Feature of a scene that shoes do not have, None if there is nothing."""
    ground = scene.ground
    if scene.in_space or scene.body != "chain":
        return "shoes are for strips of body chain"
    if not isinstance(ground, Surface) or depends_on_speed(ground) or ground.adhesion:
        return "shoes are for uniform ground that neither sticks nor resists by speed"
    if not ground.is_round:
        return "shoes resist alike ahead and back"
    if scene.strip.feet:
        return "shoes are for strips without feet"
    if scene.between or scene.slope:
        return "shoes are for friction at the two ends on level ground"
    if scene.friction != "constant":
        return f"shoes have constant bounds, not those of friction {scene.friction}"
    if min(min(stage) for stage in scene.gait.stages) < 0:
        return "shoes are for pressures from 0 up"
    return None


class SignedLength(NamedTuple):
    """Affine function l of the pressures, of one end.

    Attributes:
        rest: l_0 [m].
        slopes: l_j, of each chamber at the peak pressure, (S,) [m].
    """

    rest: float
    slopes: Array


def signed_lengths(scene: Scene) -> tuple[SignedLength, SignedLength]:
    """l of the left and of the right end, along the scene's gait."""
    model = Elastica(_LINKS, scene.chamber)
    walk = predict(scene.strip, scene.gait, scene.ground, model, _STATES, scene.reference_friction)
    lengths = walk.shapes.contact_left, walk.shapes.contact_right
    return _of_end(scene, walk, 0, lengths[0]), _of_end(scene, walk, -1, lengths[1])


def _of_end(scene: Scene, walk: Prediction, end: int, contact: Array) -> SignedLength:
    """Weighted least squares over the states in which an end's own chamber is not inflated.

    States with a contact of length 0 only count where l is above 0. Weights are largest where l
    decides: near 0, and where the side resists as a tip does. States that were located between
    those of the gait are left out: how many there are hangs on the last digit.
    """
    strip, surface = scene.strip, scene.ground.at(0.0)
    length, pressure = strip.length, np.abs(walk.pressures) / strip.peak_pressure
    chambers = pressure.shape[1]
    chamber = end % chambers
    parts = pressure * _STATES
    regular = (np.abs(parts - np.round(parts)) < _REGULAR).all(axis=1)
    seen = (pressure[:, chamber] <= PASSIVE) & (pressure.max(axis=1) > _FLAT) & np.isfinite(contact)
    seen &= regular
    slopes, rest = np.zeros(chambers), 0.5 * length
    if seen.any():
        part = contact[seen] / length
        weight = 1.0 / (part + _NEAR)
        if surface.shear_strength and surface.tip_force:
            alike = surface.tip_force / (surface.shear_strength * strip.width * length)
            weight = weight + 1.0 / (np.abs(part - alike) + _NEAR)
        terms = np.column_stack([np.ones(len(part)), -np.delete(pressure[seen], chamber, axis=1)])
        counts = part > 0
        for _ in range(_ROUNDS):
            rows = weight[counts, None] * terms[counts]
            coefficients = np.linalg.lstsq(rows, weight[counts] * part[counts])[0]
            before, counts = counts, (part > 0) | (terms @ coefficients > 0)
            if (counts == before).all():
                break
        rest = length * max(float(coefficients[0]), _TAKES_OVER)
        slopes[np.arange(chambers) != chamber] = length * coefficients[1:]
    # with so much pressure of its own an end is a tip, whatever the others do
    slopes[chamber] = (rest + _TAKES_OVER * length) / PASSIVE
    return SignedLength(rest, slopes)


def add_shoes(spec: mujoco.MjSpec, scene: Scene, numerics: Resolved) -> None:
    """Give a strip with actuators and friction tendons its shoes, and take the tendons' bounds.

    Args:
        spec: the scene, as of mjsim.model.builder.scene_spec.
        scene: without `refusal`, its chambers at constant pressure with actuators.
        numerics: of the walk.
    """
    strip, surface = scene.strip, scene.ground.at(0.0)
    spec.option.cone, spec.option.impratio = mujoco.mjtCone.mjCONE_ELLIPTIC, _IMPRATIO
    widest = surface.shear_strength * strip.width * strip.length / len(strip.segments)
    for name in ENDS:
        spec.tendon(PREFIX + name).frictionloss = 0.0
    tied = 0.0 if strip.tether and strip.tether.resists else _TIE
    spec.tendon(PREFIX + TENDONS[2]).frictionloss = tied * max(surface.tip_force, widest)
    side, tip = (
        surface.shear_strength * strip.width,
        surface.tip_force / (_TAKES_OVER * strip.length),
    )
    for end, place, signed in zip(ENDS, (0.0, strip.length), signed_lengths(scene), strict=True):
        if side > 0:
            _Shoe("side", end, place, scene, numerics).press(
                spec, signed, side, side * strip.length
            )
        if tip > 0:
            _Shoe("tip", end, place, scene, numerics).press(spec, signed, -tip, surface.tip_force)


class _Shoe(NamedTuple):
    """One shoe, before it is made.

    Attributes:
        kind: side or tip.
        end: left or right.
        place: of the end at rest [m].
        scene, numerics: what it is for.
    """

    kind: str
    end: str
    place: float
    scene: Scene
    numerics: Resolved

    def press(self, spec: mujoco.MjSpec, signed: SignedLength, bound: float, most: float) -> None:
        """Add it, pressed by bound * l / mu where that is above 0.

        Args:
            spec: the scene.
            signed: l.
            bound: friction per l [N/m]; below 0 of a tip, which is in the air at rest.
            most: strongest friction [N].
        """
        scene, robot = self.scene, self.scene.strip
        name = f"{PREFIX}{self.kind}_{self.end}"
        rest = bound * signed.rest / _MU  # what the spring presses it by on the ground [N]
        spring = abs(rest) / _TRAVEL
        lifted = _TRAVEL if rest < 0 else 0.0
        body = spec.worldbody.add_body(name=name, pos=(self.place, 0.0, _RADIUS + lifted))
        mass = robot.weight / scene.gravity
        body.mass, body.inertia, body.explicitinertial = _MASS * mass, [_INERTIA] * 3, True
        body.ipos = ORIGIN
        armature = _ARMATURE * mass
        slide = mujoco.mjtJoint.mjJNT_SLIDE
        body.add_joint(name=f"{name}_x", type=slide, axis=(1, 0, 0), armature=armature)
        down = body.add_joint(name=f"{name}_z", type=slide, axis=(0, 0, 1), armature=armature)
        down.stiffness[0], down.springref = spring, 0.0 if lifted else -_TRAVEL
        down.damping[0] = 2.0 * _DAMPING * (spring * armature) ** 0.5
        # chambers lift a side no farther than off the ground, and press a tip by no more than V_t
        down.actfrclimited = int(mujoco.mjtLimited.mjLIMITED_TRUE)
        down.actfrcrange[:] = (-(most / _MU - rest), abs(rest))
        pad = body.add_geom(name=f"{name}_pad", pos=ORIGIN)
        pad.type, pad.size[0], pad.mass = mujoco.mjtGeom.mjGEOM_SPHERE, _RADIUS, 0.0
        pad.contype, pad.conaffinity, pad.condim, pad.priority, pad.group = 1, 0, 3, 1, 3
        pad.friction[:] = _MU, 0.0, 0.0
        time = self.numerics.contact_time * self.numerics.timestep
        pad.solref[:], pad.solimp[:3] = softness_with_friction(time, self.numerics.contact_depth)
        self._follow_end(spec, name, time)
        bend = pneunet.curvature_per_pressure(robot) * pneunet.base_rigidity(robot)
        for number, slope in enumerate(signed.slopes.tolist(), start=1):
            # of the actuator, whose force on its tendon is -bend times the pressure
            press = bound * slope / _MU / (bend * robot.peak_pressure)
            if press:
                spec.tendon(f"{PREFIX}segment_{number}").wrap_joint(down.name, -press)

    def _follow_end(self, spec: mujoco.MjSpec, name: str, time: float) -> None:
        """Couple its place along x to that of its end, with a softness of so much time [s]."""
        place = spec.add_tendon(name=f"{name}_place", group=4)
        place.wrap_joint(f"{name}_x", 1.0)
        follow = spec.add_equality(name=name, type=mujoco.mjtEq.mjEQ_TENDON, name1=place.name,
                                   name2=PREFIX + self.end)  # fmt: skip
        follow.objtype = mujoco.mjtObj.mjOBJ_TENDON
        follow.data[:5] = 0.0, 1.0, 0.0, 0.0, 0.0
        follow.solref[:], follow.solimp[:3] = (time, 1.0), (0.999, 0.999, 0.001)
