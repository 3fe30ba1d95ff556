"""Which OpenGL backend renders without a screen: EGL, else OSMesa, else none.

MuJoCo reads MUJOCO_GL once, when it is imported, and has no fallback; a backend whose library is
there can still fail at the first context. So the default is set from the libraries present, and
`find_backend` tries each one in a child process before a video is promised.
"""

import ctypes.util
import os
import subprocess
import sys

VARIABLE = "MUJOCO_GL"
NONE = "off"
_LIBRARIES = {"egl": "EGL", "osmesa": "OSMesa"}
_PROBE = (
    "import mujoco as m\n"
    "with m.Renderer(m.MjModel.from_xml_string('<mujoco/>'), 8, 8) as renderer:\n"
    "    renderer.render()\n"
)
_PROBE_TIMEOUT = 60  # s; software rendering compiles its shaders on first use

HELP = (
    "no OpenGL backend renders here, so no video can be made; install libegl1 and libgl1-mesa-dri "
    "(Debian: apt-get install libegl1 libgl1-mesa-dri), or pass --no-video"
)


def set_default_backend() -> None:
    """Set MUJOCO_GL from the libraries on this machine, unless the user has set it."""
    found = (name for name, lib in _LIBRARIES.items() if ctypes.util.find_library(lib))
    os.environ.setdefault(VARIABLE, next(found, NONE))


def cases(backend: str) -> bool:
    """Whether a child process can render one frame with this backend."""
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
    chosen = os.environ.get(VARIABLE, NONE)
    candidates = [chosen, *_LIBRARIES] if chosen != NONE else [*_LIBRARIES]
    return next((name for name in dict.fromkeys(candidates) if cases(name)), None)


def use_backend() -> str | None:
    """Set MUJOCO_GL to the backend that renders and return it; call before mujoco is imported."""
    backend = find_backend()
    if backend:
        os.environ[VARIABLE] = backend
    return backend
