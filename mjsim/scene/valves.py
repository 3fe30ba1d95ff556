"""Valves and chambers of real robots: they fill and vent late, slowly and not alike.

How slowly: of the pressure logs of Schaff, Sedal, Ni and Walter (2023), "Sim-to-real transfer of
co-optimized soft robot crawlers", Autonomous Robots 47 (github.com/macrobotics-lab/
AuRo_evolving_sobot_data; three pneu-nets, regulators, commands every 1.067 s), 14 % of the pressure
is left 1.067 s after a command to vent (median of 3,052, quartiles 5 and 22 %): a time constant of
0.54 s. Filling is at the command by then within the gain of the sensors, 10 %: 0.46 s at most.
"""

import math
from dataclasses import dataclass, fields

from analytic.checks import not_negative
from analytic.fields import in_si

PerSegment = float | tuple[float, ...]

MEASURED_TIME = 0.5  # s; of a pneu-net crawler, see above


@dataclass(frozen=True)
class Valves:
    """Dynamics by which the pressure in the chambers follows the commands of the valves.

    A command acts after the dead time; then the chamber's pressure approaches it exponentially, by
    one time constant while it fills and by another while it vents, and never faster than the flow
    limit. Each may be one number, or one per segment, left first.

    Raises:
        ValueError: a number is negative, or a flow limit is not positive.
    """

    fill_time: PerSegment = 0.0
    """time constant with which chambers fill [s]; 0.5 measured of a pneu-net crawler"""
    vent_time: PerSegment | None = None
    """time constant with which they vent [s]; as they fill if not given"""
    dead_time: PerSegment = 0.0
    """from a command to its first effect [s]"""
    flow_limit: PerSegment | None = None
    """fastest change of pressure that the supply and the tubes let through [Pa/s]; none if not
    given"""

    def __post_init__(self) -> None:
        in_si(self)
        for field in fields(self):
            value = getattr(self, field.name)
            if value is None:
                continue
            unit = "Pa/s" if field.name == "flow_limit" else "s"
            each = tuple(value) if isinstance(value, tuple | list) else (value,)
            for part in each:
                not_negative(field.name, part, unit)
                if field.name == "flow_limit" and part == 0:
                    raise ValueError(f"flow_limit must be above 0 Pa/s, got {value!r}")
            numbers = tuple(float(part) for part in each)
            object.__setattr__(self, field.name, numbers if len(numbers) > 1 else numbers[0])

    def of(self, name: str, segments: int) -> tuple[float, ...]:
        """Numbers of a field, one per segment; infinity where there is no flow limit."""
        value = getattr(self, name)
        if value is None:
            value = self.fill_time if name == "vent_time" else math.inf
        return value if isinstance(value, tuple) else (value,) * segments

    def slower(self, times: float) -> "Valves":
        """Valves that are slower, by so many times."""
        slow: dict[str, PerSegment | None] = {}
        for field in fields(self):
            value, factor = getattr(self, field.name), times
            if field.name == "flow_limit":
                factor = 1 / times
            if isinstance(value, tuple):
                slow[field.name] = tuple(factor * each for each in value)
            else:
                slow[field.name] = None if value is None else factor * value
        return Valves(**slow)  # type: ignore[arg-type]

    def check(self, segments: int) -> None:
        """Raise ValueError where numbers are given for another number of segments."""
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, tuple) and len(value) != segments:
                raise ValueError(f"{field.name} must be one number or {segments}, got {value!r}")

    @property
    def ideal(self) -> bool:
        """Tell whether the pressure in the chambers is that of the commands."""
        return not (self.lags or self.flow_limit or self.dead)

    @property
    def lags(self) -> bool:
        """Tell whether chambers fill or vent in time."""
        return any(self.of("fill_time", 1)) or any(self.of("vent_time", 1))

    @property
    def dead(self) -> bool:
        """Tell whether a command acts later."""
        return any(self.of("dead_time", 1))

    @property
    def time_constant(self) -> float | None:
        """Time constant if all are one first-order filter, or None if they are more than that."""
        if self.dead or self.flow_limit:
            return None
        times = {*self.of("fill_time", 1), *self.of("vent_time", 1)}
        return times.pop() if len(times) == 1 else None
