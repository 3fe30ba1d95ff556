"""Draw which package imports which, from the code itself: `make architecture`."""

import ast
from pathlib import Path

from matplotlib.figure import Figure

TOP = Path(__file__).resolve().parent.parent
PACKAGES = ("analytic", "mjsim", "studies")
_COLUMNS = {  # where a package is drawn: column, row
    "analytic": (0, 2), "analytic.scene": (0, 3.3), "analytic.friction": (0.7, 0.3),
    "analytic.solvers": (0, 0.7),
    "mjsim.scene": (1, 1.4), "mjsim.files": (2, 3.7),
    "mjsim.model": (2, 2.2), "mjsim.friction": (3, 1.2), "mjsim.results": (3, 3.4),
    "mjsim.simulation": (4, 2.4), "mjsim.pictures": (5, 3.4), "mjsim.env": (5, 0.55),
    "mjsim.fitting": (5, 1.5), "mjsim.sweeps": (5.7, 3.95), "mjsim.optimising": (6, 1.4),
    "mjsim.commands": (6.5, 2.4), "studies": (6.5, 0.6),
}  # fmt: skip
_LABEL = {"analytic": "analytic\n(theory)"}


def package_of(module: str) -> str:
    """The package that a module is drawn as; commands are `mjsim`."""
    parts = module.split(".")
    for length in (2, 1):
        name = ".".join(parts[:length])
        if name in _COLUMNS:
            return name
    return parts[0]


def imports() -> set[tuple[str, str]]:
    """Pairs of modules, importer first, those inside functions included."""
    pairs = set()
    for path in (path for package in PACKAGES for path in (TOP / package).rglob("*.py")):
        module = ".".join(path.relative_to(TOP).with_suffix("").parts).removesuffix(".__init__")
        if module in PACKAGES:
            continue  # names that are imported when they are first used
        tree = ast.parse(path.read_text(encoding="utf-8"))
        tree.body = [node for node in tree.body if not _for_types_only(node)]
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.module:
                names = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
                known = [name for name in names if (TOP / name.replace(".", "/")).is_dir()
                         or (TOP / (name.replace(".", "/") + ".py")).is_file()]  # fmt: skip
                targets = known[-1:] or names[:1]
                pairs |= {(module, t) for t in targets if t.split(".")[0] in PACKAGES}
    return pairs


def _for_types_only(node: ast.stmt) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"


def arrows() -> set[tuple[str, str]]:
    """Pairs of packages, importer first."""
    pairs = {(package_of(one), package_of(two)) for one, two in imports()}
    return {(one, two) for one, two in pairs if one != two}


def draw() -> Figure:
    """Imports as arrows from right to left."""
    figure = Figure(figsize=(11, 4.6), dpi=110)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-0.6, 6.6), ylim=(0.2, 4.2))
    axes.axis("off")
    for one, two in sorted(arrows()):
        far = two.startswith("analytic") and not one.startswith("analytic")
        axes.annotate("", _COLUMNS[two], _COLUMNS[one], arrowprops={
            "arrowstyle": "-|>", "color": "0.85" if far else "0.45", "shrinkA": 26, "shrinkB": 30,
            "lw": 0.9}, zorder=0 if far else 1)  # fmt: skip
    for name, place in _COLUMNS.items():
        text = _LABEL.get(name, name.removeprefix("mjsim.").removeprefix("analytic."))
        shade = "#dbe9f4" if name.startswith("analytic") else "#f6e7d8"
        axes.text(*place, text, ha="center", va="center", fontsize=9, zorder=2,
                  bbox={"boxstyle": "round,pad=0.5", "fc": shade, "ec": "0.4"})  # fmt: skip
    return figure


if __name__ == "__main__":
    draw().savefig(TOP / "docs" / "architecture.png")
