"""The robot: a strip of pneu-net segments, as plain data."""

from dataclasses import dataclass, fields
from itertools import accumulate

from analytic.checks import one_of, positive
from analytic.fields import in_si, records
from analytic.scene.actuator import Actuator
from analytic.scene.feet import Foot, in_order
from analytic.scene.materials import MATERIALS
from analytic.scene.payload import Payload, payloads
from analytic.scene.tether import Tether

PSI = 6894.757293168  # Pa in a pound-force per square inch (NIST SP 811)
GRAVITY = 9.81  # m/s^2
THREE_EQUAL = (1.0, 1.0, 1.0)  # [Majidi13], section 2.3

_THREE = ("left", "middle", "right")
_OPTIONAL = ("mass", "rigidity", "curvature_per_pressure", "rigidity_per_pressure", "torsion")
# fields that are no number
_OTHERS = ("segments", "material", "actuator", "feet", "payload", "tether")
_SAME = 1e-9  # of a modulus that is given and follows from the actuator too


@dataclass(frozen=True)
class Robot:
    """A planar strip of segments, each one a pneu-net of the same design.

    The weight and the chamber height of the default robot are identified from two statements of
    [Majidi13] by `python -m studies.identification`; the other values are chosen.

    A number may be a text with its unit, as in length="110 mm", and is in SI then.

    What was measured may be given in place of what it follows from: mass for weight_per_length,
    rigidity or material for modulus (all are turned into the other at once), curvature_per_pressure
    and rigidity_per_pressure for what the chambers' geometry gives, torsion for what modulus and
    section give, and an actuator for the affine laws themselves.

    Raises:
        ValueError: a value is not a positive finite number, there is no segment, chamber_fraction
            exceeds 1, one quantity is given in two ways, or feet overlap.
    """

    length: float = 0.130
    """L [m]"""
    width: float = 0.040
    """q, also the depth "w" of (1)-(9) [m]"""
    modulus: float = 1.8e6
    """E of the strain-limiting layer [Pa]"""
    thickness: float = 4.0e-3
    """t of the strain-limiting layer [m]"""
    chamber_height: float = 3.928e-3
    """H [m]; identified"""
    chamber_fraction: float = 0.7
    """c/x, chamber width over the arclength it occupies [1]"""
    weight_per_length: float = 1.416
    """w of Appendix A [N/m]; identified"""
    peak_pressure: float = 7.0 * PSI
    """p [Pa]; [Majidi13], section 3"""
    segments: tuple[float, ...] = THREE_EQUAL
    """lengths of the segments, left first, in any common unit"""
    mass: float | None = None
    """of the whole robot, in place of weight_per_length [kg]"""
    rigidity: float | None = None
    """D0, flexural rigidity without pressure, in place of modulus [N m^2]"""
    curvature_per_pressure: float | None = None
    """alpha of (3), in place of what the chambers give [1/(m Pa)]"""
    rigidity_per_pressure: float | None = None
    """eta of (9), in place of what the chambers give [N m^2/Pa]"""
    torsion: float | None = None
    """GJ, torsional rigidity of a limb, in place of that of its solid section [N m^2]"""
    material: str | None = None
    """of the strain-limiting layer, in place of modulus: ecoflex-00-30, dragon-skin-10-medium,
    ..."""
    actuator: Actuator | tuple[Actuator, ...] | None = None
    """curvature, and rigidity where it was measured, over pressure, in place of what the chambers
    give: files of pressure and angle or curvature, one for all segments or one per segment"""
    feet: tuple[Foot, ...] = ()
    """stretches of its underside that resist otherwise than its skin: tables of begin, end, grip,
    grip_back, grip_across, hold, damping, drop and chamber; as an option 0..0.1 grip_back=2, 1..1
    hold=50mN"""
    payload: tuple[Payload, ...] = ()
    """masses that it carries besides its own: tables of mass, begin and end; as an option 0.5
    mass=5g, 0.2..0.4 mass=3g"""
    tether: Tether | None = None
    """tube or cable that it drags along: a table of at, drag, stiffness and mass; as an option 0
    drag=5mN stiffness=1N/m mass=2g"""

    def __post_init__(self) -> None:
        in_si(self)
        if isinstance(self.segments, str) or not hasattr(self.segments, "__iter__"):
            raise ValueError(f"segments must be lengths, one per segment, got {self.segments!r}")
        object.__setattr__(self, "segments", tuple(self.segments))
        if not self.segments:
            raise ValueError("segments must be at least one length, got none")
        for length in self.segments:
            positive("segments' lengths", length)
        object.__setattr__(self, "segments", tuple(float(part) for part in self.segments))
        object.__setattr__(self, "feet", in_order(self.feet))
        object.__setattr__(self, "payload", payloads(self.payload))
        if self.tether is not None:
            object.__setattr__(self, "tether", records(Tether, "tether", [self.tether])[0])
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name in _OTHERS or (value is None and field.name in _OPTIONAL):
                continue
            positive(field.name, value)
            object.__setattr__(self, field.name, float(value))
        if self.chamber_fraction > 1:
            raise ValueError(
                f"chamber_fraction must lie in (0, 1], got {self.chamber_fraction!r}: "
                "a chamber cannot be wider than the strip it sits on"
            )
        if self.mass is not None:
            self._replace_default("weight_per_length", "mass", self.mass * GRAVITY / self.length)
        if self.rigidity is not None:
            layer = self.width * self.thickness**3 / 12
            self._replace_default("modulus", "rigidity", self.rigidity / layer)
        if self.material is not None:
            one_of("material", self.material, MATERIALS)
            self._replace_default("modulus", "material", MATERIALS[self.material])
        if self.actuator is not None:
            self._take_actuator()

    def _replace_default(self, name: str, given: str, value: float) -> None:
        """Put what was given in other terms into the field that the theory uses."""
        if getattr(self, name) != getattr(type(self), name):
            raise ValueError(f"{given} or {name} must be given, not both; got "
                             f"{getattr(self, given)!r} and {getattr(self, name)!r}")  # fmt: skip
        object.__setattr__(self, name, value)
        object.__setattr__(self, given, None)

    def _take_actuator(self) -> None:
        """Check the measured curves, and take from them the rigidity that they begin with."""
        if not isinstance(self.actuator, Actuator):
            object.__setattr__(self, "actuator", tuple(self.actuator or ()))
        curves = [curve for curve in self.actuators if curve]
        if len(curves) != len(self.segments):
            raise ValueError(f"actuator must be one, or {len(self.segments)}, one per segment, got "
                             f"{len(curves)}")  # fmt: skip
        stiff = {curve.rigidity[0] for curve in curves if curve.rigidity}
        measured = sum(curve.rigidity is not None for curve in curves)
        for name, given in (("curvature_per_pressure", True), ("rigidity_per_pressure", measured)):
            if given and getattr(self, name) is not None:
                raise ValueError(f"actuator or {name} must be given, not both; got {name} "
                                 f"{getattr(self, name)!r}")  # fmt: skip
        if measured and (measured < len(curves) or len(stiff) > 1):
            raise ValueError("actuator must have one rigidity at no pressure in all segments, got "
                             f"{sorted(stiff)} in {measured} of {len(curves)}")  # fmt: skip
        if measured:
            modulus = stiff.pop() / (self.width * self.thickness**3 / 12)
            if self.modulus != Robot.modulus and abs(self.modulus / modulus - 1) > _SAME:
                raise ValueError("the rigidity of the actuator or modulus must be given, not both; "
                                 f"got a modulus of {self.modulus:g} Pa")  # fmt: skip
            object.__setattr__(self, "modulus", modulus)

    @property
    def actuators(self) -> tuple[Actuator | None, ...]:
        """Measured curve of each segment, None of those by the affine laws."""
        if isinstance(self.actuator, tuple):
            return self.actuator
        return (self.actuator,) * len(self.segments)

    @property
    def borders(self) -> tuple[float, ...]:
        """Borders of segments, both ends of the strip included, over its length [1]."""
        total = sum(self.segments)
        inner = accumulate(self.segments[:-1])
        return (0.0, *(end / total for end in inner), 1.0)

    @property
    def chambers(self) -> tuple[str, ...]:
        """Names of the segments, a gait's columns: left, middle, right of three, else numbers."""
        count = len(self.segments)
        return _THREE if count == 3 else tuple(f"{number}" for number in range(1, count + 1))

    @property
    def flat_height(self) -> float:
        """Height of the flat strip over the ground: its layer, and the chambers on it [m]."""
        return self.thickness + self.chamber_height

    @property
    def weight(self) -> float:
        """Weight of the robot and what it carries [N]."""
        return self.weight_per_length * self.length + GRAVITY * self.payload_mass

    @property
    def carried(self) -> tuple[Payload, ...]:
        """Its payloads, and what it carries of its tether."""
        if self.tether is None or not self.tether.mass:
            return self.payload
        return (*self.payload, Payload(self.tether.mass, self.tether.at))

    @property
    def payload_mass(self) -> float:
        """Mass of all that it carries [kg]."""
        return sum(payload.mass for payload in self.carried)
