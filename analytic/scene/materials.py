"""Moduli of silicones, by name."""

from collections.abc import Mapping
from types import MappingProxyType

# Young's moduli at small strain [Pa]: slopes from strain 0.1 to 1 of the tensile curves (ASTM D412)
# of LucMarechal/Soft-Robotics-Materials-Database, L. Marechal, P. Balland, L. Lindenroth,
# F. Petrou, C. Kontovounisios and F. Bello, "Toward a common framework and database of materials
# for soft robotics", Soft Robotics 8 (2021). A batch may differ by a third.
MATERIALS: Mapping[str, float] = MappingProxyType({
    "ecoflex-00-10": 0.024e6,
    "ecoflex-00-30": 0.048e6,
    "ecoflex-00-50": 0.067e6,
    "dragon-skin-fx-pro": 0.098e6,
    "dragon-skin-10-medium": 0.169e6,
    "dragon-skin-20": 0.478e6,
    "dragon-skin-30": 0.668e6,
    "platsil-gel-10": 0.215e6,
    "rtv615": 1.20e6,
})  # fmt: skip
