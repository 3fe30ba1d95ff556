"""Optional packages, each named by the extra that installs it."""

from importlib import import_module
from typing import Any

_EXTRAS = {  # package: extra of this distribution
    "cma": "optimise",
    "distributed": "cluster",
    "plotly": "report",
    "pyarrow": "parquet",
}


def optional(package: str, purpose: str) -> Any:
    """An optional package, imported.

    Args:
        package: its name.
        purpose: what needs it, the beginning of the message.

    Raises:
        ModuleNotFoundError: it is not installed; the message names what to install.
    """
    try:
        return import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise ModuleNotFoundError(
            f"{purpose} needs {package}: pip install 'undulator[{_EXTRAS[package]}]'", name=package
        ) from error
