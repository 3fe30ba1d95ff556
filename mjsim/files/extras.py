"""Optional packages: one line says what to install where one is missing."""

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

_EXTRAS = {  # package: extra of this distribution
    "cma": "optimise",
    "distributed": "cluster",
    "gymnasium": "gym",
    "plotly": "report",
    "pyarrow": "parquet",
}


class MissingExtraError(ModuleNotFoundError):
    """A package that an extra brings is not installed."""


@contextmanager
def needed(package: str, purpose: str) -> Iterator[None]:
    """Imports of an optional package.

    Args:
        package: its name.
        purpose: what needs it, the beginning of the message.

    Raises:
        MissingExtraError: it is not installed; the message names what to install.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != package:
            raise
        raise MissingExtraError(
            f"{purpose} needs {package}: pip install 'undulator[{_EXTRAS[package]}]'", name=package
        ) from error


def optional(package: str, purpose: str) -> Any:
    """An optional package, imported; see needed."""
    with needed(package, purpose):
        return import_module(package)
