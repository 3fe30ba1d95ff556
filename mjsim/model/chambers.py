"""Pressure in the chambers, which follows the valves."""

import numpy as np
from numpy.typing import NDArray

from mjsim.scene.valves import Valves

Array = NDArray[np.float64]


class ChamberPressures:
    """Pressures in chambers that follow their valves, none at first.

    Args:
        valves: which they follow.
        segments: number of chambers.
        timestep: between commands [s].

    Attributes:
        pressure: at the end of the last step, (S,) [Pa].
    """

    def __init__(self, valves: Valves, segments: int, timestep: float) -> None:
        self.pressure: Array = np.zeros(segments)
        self._ideal = valves.ideal
        self._chambers = list(zip(
            _kept(valves.of("fill_time", segments), timestep).tolist(),
            _kept(valves.of("vent_time", segments), timestep).tolist(),
            (np.array(valves.of("flow_limit", segments)) * timestep).tolist(),
            strict=True,
        ))  # fmt: skip
        self._late = np.rint(np.array(valves.of("dead_time", segments)) / timestep).astype(int)
        self._commands: Array = np.zeros((int(self._late.max()), segments))

    def follow(self, valves: Array) -> Array:
        """Pressure at the end of each step, (T, S) [Pa], of commands during each, (T, S) [Pa]."""
        if self._ideal or not len(valves):
            if len(valves):
                self.pressure = valves[-1]
            return valves
        # plain floats: numpy is slow on a few numbers
        pressures = []
        pressure: list[float] = self.pressure.tolist()
        for commands in self._delayed(valves).tolist():
            pressure = [
                before + min(max((1 - (filling if abs(command) > abs(before) else venting))
                                 * (command - before), -most), most)
                for command, before, (filling, venting, most)
                in zip(commands, pressure, self._chambers, strict=True)
            ]  # fmt: skip
            pressures.append(pressure)
        self.pressure = np.array(pressure)
        return np.array(pressures)

    def _delayed(self, valves: Array) -> Array:
        """Commands that act during each step, (T, S) [Pa]."""
        most = len(self._commands)
        if not most:
            return valves
        commands = np.concatenate([self._commands, valves])
        rows = np.arange(len(valves))[:, None] + most - self._late
        self._commands = commands[-most:]
        return np.asarray(commands[rows, np.arange(valves.shape[1])])


def _kept(times: tuple[float, ...], timestep: float) -> Array:
    """Part of a difference from the command that is left after a step."""
    constants = np.array(times)
    safe = np.where(constants > 0, constants, 1.0)
    return np.where(constants > 0, np.exp(-timestep / safe), 0.0)
