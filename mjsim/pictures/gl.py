"""OpenGL backend that renders without a screen: EGL, else OSMesa, else none.

MuJoCo reads MUJOCO_GL once, when it is imported, and has no fallback; a backend whose library is
there can still fail at the first context. So `find_backend` tries each one in a child process
before a video is promised, and videos are drawn in processes of their own.
"""

import os
import subprocess
import sys

VARIABLE = "MUJOCO_GL"
NONE = "off"
_BACKENDS = ("egl", "osmesa")
_PROBE = (
    "import mujoco as m\n"
    "with m.Renderer(m.MjModel.from_xml_string('<mujoco/>'), 8, 8) as renderer:\n"
    "    renderer.render()\n"
)
_chosen: dict[str, str] = {}  # what the user asked for, before `prepare`
_PROBE_TIMEOUT = 60  # s; software rendering compiles its shaders on first use

HELP = (
    "no OpenGL backend renders here, so no video can be made; install libegl1 and libgl1-mesa-dri "
    "(Debian: apt-get install libegl1 libgl1-mesa-dri), or pass --no-video"
)


def prepare() -> None:
    """Let mujoco be imported without OpenGL, for a program that draws in other processes only.

    An OpenGL that MUJOCO_GL or PYOPENGL_PLATFORM names and that is not there would else fail at the
    import, of a program that draws nothing, too.
    """
    if "mujoco" not in sys.modules:
        _chosen.setdefault(VARIABLE, os.environ.get(VARIABLE, NONE))
        os.environ[VARIABLE] = NONE
        os.environ.pop("PYOPENGL_PLATFORM", None)


def renders(backend: str) -> bool:
    """True if a child process can render one frame with this backend."""
    environment = {**os.environ, VARIABLE: backend}
    environment.pop("PYOPENGL_PLATFORM", None)
    try:
        child = subprocess.run(
            [sys.executable, "-c", _PROBE],
            env=environment,
            capture_output=True,
            timeout=_PROBE_TIMEOUT,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return False
    return child.returncode == 0


def find_backend() -> str | None:
    """First backend that renders: the one in MUJOCO_GL, then EGL, then OSMesa; None if none does.

    See `use_backend`.
    """
    chosen = _chosen.get(VARIABLE) or os.environ.get(VARIABLE, NONE)
    candidates = [chosen, *_BACKENDS] if chosen != NONE else [*_BACKENDS]
    return next((name for name in dict.fromkeys(candidates) if renders(name)), None)


def use_backend() -> str | None:
    """Set MUJOCO_GL to the backend that renders, for processes that start later; return it."""
    backend = find_backend()
    if backend:
        os.environ[VARIABLE] = backend
    return backend
