"""Build the API reference from the docstrings, any warning an error: `make reference`."""

import importlib
import os
import pkgutil
import sys
import warnings
from pathlib import Path

os.environ.setdefault("PDOC_ALLOW_EXEC", "1")  # glfw asks its library's version in a process

import pdoc
import pdoc.render

import analytic
import mjsim
from mjsim.files.command_line.cli import fail


def modules() -> list[str]:
    """Names of every module of the product."""
    names = ["analytic", "mjsim"]
    for package in (analytic, mjsim):
        names += [
            module.name
            for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
            if "__main__" not in module.name
        ]
    return names


def main(folder: Path) -> None:
    """Write HTML, of the modules for dm_control too."""
    try:
        importlib.import_module("mjsim.env.dm_binding")
    except ImportError as error:
        fail("scripts/reference.py", str(error))
    for package in (analytic, mjsim):
        for name in package.__all__:
            getattr(package, name)  # names that are imported when they are first used
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # a package without __all__ brings its modules by itself
        warnings.filterwarnings("ignore", "The module specification")
        folders = Path(__file__).with_name("reference")
        pdoc.render.configure(template_directory=folders, show_source=False)
        pdoc.pdoc(*modules(), output_directory=folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("build/reference"))
