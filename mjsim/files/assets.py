"""Folder of the MJCF files: in the package of a wheel, at the top of a checkout."""

from pathlib import Path

_HERE = Path(__file__).resolve().parent.parent  # the package
MODELS = next(folder for folder in (_HERE / "models", _HERE.parent / "models") if folder.is_dir())
BARE = _HERE / "model" / "bare.xml"  # the ground alone, with nothing to look at
