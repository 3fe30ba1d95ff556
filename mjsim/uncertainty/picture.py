"""Bar chart of the effects of fields."""

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from mjsim.files.files import whole
from mjsim.uncertainty.sensitivity import Effect, Effects

_MOST = 16  # bars of a scene; chosen
_AHEAD, _BACK = "C0", "C3"


def draw(scenes: Mapping[str, Effects], path: Path) -> None:
    """Draw a panel per scene, a bar per field: the distance that one per cent more of it adds.

    Args:
        scenes: effects by the names of scenes.
        path: of the picture; it appears when it is whole.

    Raises:
        OSError: it cannot be written.
    """
    told = {name: _told(effects) for name, effects in scenes.items()}
    rows = max(max((len(bars) for bars in told.values()), default=1), 3)
    figure = Figure(figsize=(5.2 * len(scenes), 1.2 + 0.24 * rows), layout="constrained", dpi=100)
    panels = figure.subplots(1, len(scenes), squeeze=False)[0]
    for (name, bars), panel in zip(told.items(), panels, strict=True):
        labels = [effect.field for effect in bars]
        changes = [1e6 * (effect.distance or 0.0) for effect in bars]
        colors = [_AHEAD if change > 0 else _BACK for change in changes]
        errors = [1e6 * effect.error for effect in bars]
        panel.barh(labels, changes, xerr=errors if any(errors) else None, color=colors)
        panel.invert_yaxis()
        panel.axvline(0, color="0.6", lw=0.8)
        panel.set_title(f"{name}: {1e3 * scenes[name].distance:+.2f} mm per cycle", fontsize=9)
        panel.set_xlabel("ahead by one per cent more of it [µm per cycle]", fontsize=8)
        panel.tick_params(labelsize=8)
        panel.margins(y=0.01)
    kind = path.suffix.removeprefix(".")
    with whole(path) as part:
        figure.savefig(part, format=kind)


def _told(effects: Effects) -> list[Effect]:
    """The greatest effects that are known and not none."""
    return [effect for effect in effects.effects if effect.distance][:_MOST]
