"""Packages that only some installations have: one line says what to install."""

from collections.abc import Iterator
from contextlib import contextmanager


class MissingExtraError(ModuleNotFoundError):
    """A package that an extra brings is not installed."""


@contextmanager
def needed(what: str, package: str, extra: str) -> Iterator[None]:
    """Imports of a package that an extra brings.

    Args:
        what: needs it.
        package: name of its module.
        extra: of undulator, that brings it.

    Raises:
        MissingExtraError: it is not installed.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != package:
            raise
        raise MissingExtraError(
            f"{what} needs {package}, which is not installed: pip install 'undulator[{extra}]'",
            name=package,
        ) from error
