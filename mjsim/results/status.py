"""Statuses of a simulation, and heights from which on a robot has left the ground."""

from enum import StrEnum

END_HOPS = 10.0  # an end so many times as high as all of a strip may hop has left; chosen
THROWN = 0.01  # the lowest point of limbs this far off the ground, over L: all has left; chosen
AT_REST = 1e-3  # speed of the ends below which the strip is at rest before time 0 [L/s]; chosen


class Status(StrEnum):
    """End of a simulation."""

    OK = "ok"
    DIVERGED = "diverged"  # a coordinate left the range that any walk can have, or is not finite
    TOPPLED = "toppled"  # an end left the ground, or all of it: it fell over or was thrown
    SLID = "slid"  # the whole strip slid down the slope: nothing anchored it
    TURNED = "turned"  # it left its plane: turned away or fell sideways
    UNSETTLED = "unsettled"  # it was not at rest when the first cycle began


WALKED = (Status.OK, Status.SLID)  # statuses of a walk that did not fail
