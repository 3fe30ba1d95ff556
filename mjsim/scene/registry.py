"""Bodies by name; a body's module is imported when it is first built."""

from typing import TYPE_CHECKING

from analytic.registry import Registry

if TYPE_CHECKING:
    from mjsim.model.bodies.body import Body

BODIES: "Registry[Body]" = Registry(
    "undulator.bodies",
    {name: f"mjsim.model.bodies.{name}:BODY" for name in ("chain", "cable", "rod")},
)


def names() -> tuple[str, ...]:
    """Every body that a scene can name."""
    return tuple(BODIES)


def register(body: "Body") -> None:
    """Make a body known by its name."""
    BODIES[body.name] = body


def find(name: str) -> "Body":
    """The body of a name.

    Raises:
        KeyError: there is none.
        ValueError: it cannot be had in this process; the message says why.
    """
    return BODIES[name]
