"""A session in MuJoCo's viewer: one slider per chamber and one for the ground, on the right.

Physics and picture are two models: the picture is posed, and its actuators, which push nothing, are
the sliders.
"""

import contextlib
import threading
import time as clock
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import mujoco
import mujoco.viewer
import numpy as np

from analytic.scene.ground import Patches
from analytic.scene.surface import SURFACES, Ground
from mjsim.files.interruption import uninterrupted
from mjsim.model.bodies.parts import PREFIX
from mjsim.pictures.camera import hide_aids, look
from mjsim.pictures.live.session import Session
from mjsim.pictures.looks.look import Look

SPACE, BACKSPACE = 32, 259  # codes of GLFW
_FRAME = 1 / 60  # s
_PATIENCE = 10.0  # s that a window is given to close
_LATEST = 0.1  # s of real time that are made up for after a hitch
_REACH = 20.0  # lengths of the robot that the ground is shown to either side
_MOVED = 1e-3  # change of a slider below which it is rounding
_KILO = 1e3


class Shown(NamedTuple):
    """Figures of a session in a window.

    Attributes:
        frames: how many were drawn.
        wall_time: for how long it was open [s].
        simulated: how much was simulated [s].
    """

    frames: int
    wall_time: float
    simulated: float


def show(session: Session, speed: float = 1.0, seconds: float | None = None) -> Shown:
    """Open a window and play until it is closed.

    Args:
        session: what to play.
        speed: times real time.
        seconds: after which the window closes by itself.

    Raises:
        RuntimeError: there is no screen.
    """
    return _Window(session).play(speed, seconds)


class _Window:
    def __init__(self, session: Session) -> None:
        self._session = session
        self._choices = grounds(session.scene.ground)
        self._chosen = 0
        self._look = self._looks_of(session.scene.ground)
        self._keys: list[int] = []
        self._shown = self._look.data.ctrl.copy()

    def play(self, speed: float, seconds: float | None) -> Shown:
        shown_look, session = self._look, self._session
        self._pose()
        frames, simulated = 0, 0.0
        with self._opened(shown_look) as viewer:
            self._aim(viewer)
            opened = previous = clock.perf_counter()
            while viewer.is_running():
                begun = clock.perf_counter()
                if seconds is not None and begun - opened > seconds:
                    break
                passed, previous = min(begun - previous, _LATEST) * speed, begun
                self._obey(viewer)
                session.advance(passed)
                simulated += passed
                with viewer.lock():
                    self._pose()
                    self._set_sliders()
                viewer.set_texts(self._texts())
                viewer.sync()
                frames += 1
                clock.sleep(max(0.0, _FRAME - (clock.perf_counter() - begun)))
            return Shown(frames, clock.perf_counter() - opened, simulated)

    @contextlib.contextmanager
    def _opened(self, shown: Look) -> Iterator[Any]:
        """MuJoCo's viewer; when it is left, by Ctrl-C too, it draws no more."""
        threads = set(threading.enumerate())
        try:
            with uninterrupted():
                viewer = mujoco.viewer.launch_passive(
                    shown.model, shown.data, key_callback=self._keys.append, show_left_ui=False
                )
            with viewer:
                yield viewer
        finally:
            for thread in set(threading.enumerate()) - threads:
                thread.join(_PATIENCE)  # while it draws a last frame its window must be there

    def _obey(self, viewer: Any) -> None:
        """Keys, then sliders that somebody moved."""
        session = self._session
        while self._keys:
            key = self._keys.pop(0)
            if key == SPACE and session.playing:
                session.command(session.valves)
            elif key == SPACE:
                session.playing = True
            elif key == BACKSPACE:
                session.restart()
        control = self._look.data.ctrl
        choice = round(float(control[-1]))
        if choice != self._chosen:
            self._chosen = choice
            session.move_to(self._choices[choice])
            self._dress(viewer)
        elif np.abs(control[:-1] - self._shown[:-1]).max() > _MOVED:
            session.command(_KILO * control[:-1])

    def _set_sliders(self) -> None:
        self._look.data.ctrl[:] = *(self._session.valves / _KILO), self._chosen
        self._shown = self._look.data.ctrl.copy()

    def _pose(self) -> None:
        simulation, peak = self._session.simulation, self._session.scene.robot.peak_pressure
        fractions = self._session.seen.pressure / peak
        self._look.pose(simulation.nodes(), simulation.data.qpos, fractions)

    def _looks_of(self, ground: Ground) -> Look:
        scene = replace(self._session.scene, ground=ground)
        numerics = self._session.simulation.numerics
        return look(scene, numerics, _REACH * scene.robot.length, self._add_sliders)

    def _add_sliders(self, spec: mujoco.MjSpec) -> None:
        scene = self._session.scene
        most = scene.robot.peak_pressure / _KILO
        least = min(0.0, float(np.min(scene.gait.stages)) * most)
        for name in scene.robot.chambers:
            _slider(spec, f"{name} [kPa]", least, most)
        _slider(spec, "ground", 0.0, max(len(self._choices) - 1, 1e-3))

    def _dress(self, viewer: Any) -> None:
        """Give the ground that is shown the looks of another one of the same build."""
        dressed, model = self._looks_of(self._choices[self._chosen]).model, self._look.model
        with viewer.lock():
            for name in ("mat_rgba", "mat_specular", "mat_shininess", "mat_reflectance",
                         "mat_texrepeat", "geom_pos", "geom_size", "geom_rgba",
                         "tex_data"):  # fmt: skip
                getattr(model, name)[:] = getattr(dressed, name)
        for texture in range(model.ntex):
            viewer.update_texture(texture)

    def _aim(self, viewer: Any) -> None:
        length = self._session.scene.robot.length
        with viewer.lock():
            hide_aids(viewer.opt)
            camera = viewer.cam
            middle = self._session.simulation.nodes()[..., :2].reshape(-1, 2).mean(axis=0)
            camera.lookat[:] = *middle, 0.1 * length
            up = -35.0 if self._session.scene.in_space else -18.0
            camera.azimuth, camera.elevation, camera.distance = 90.0, up, 1.9 * length

    def _texts(self) -> list[tuple[Any, ...]]:
        big, corner = mujoco.mjtFontScale.mjFONTSCALE_150, mujoco.mjtGridPos
        words = self._session.words()
        sliders = ", ".join(f"{i} {ground.name}" for i, ground in enumerate(self._choices))
        keys = (("Space", "play or pause the gait"), ("Backspace", "start anew"),
                ("Control, at the right", "pressures by hand"), ("ground", sliders))  # fmt: skip
        rows = ((big, corner.mjGRID_TOPLEFT, words), (None, corner.mjGRID_BOTTOMLEFT, keys))
        return [
            (size, place, *("\n".join(column) for column in zip(*lines, strict=True)))
            for size, place, lines in rows
        ]


def grounds(first: Ground) -> list[Ground]:
    """Grounds to choose from: the scene's own, then the named ones; patches stand alone."""
    if isinstance(first, Patches):
        return [first]
    return [first, *(ground for name, ground in SURFACES.items() if name != first.name)]


def _slider(spec: mujoco.MjSpec, name: str, low: float, high: float) -> None:
    slider = spec.add_actuator(name=name)
    slider.trntype, slider.target = mujoco.mjtTrn.mjTRN_JOINT, f"{PREFIX}x"
    slider.gainprm[0] = 0.0
    slider.ctrlrange[:] = low, high
    slider.ctrllimited = int(mujoco.mjtLimited.mjLIMITED_TRUE)
