#!/usr/bin/env bash
# Make .venv with the project and its tools in it, and see that there is an OpenGL that renders
# without a screen. Needs Debian with Python 3.11 or later; works as root or not.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf 'setup: %s\n' "$*" >&2; }

apt_install() {
    [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null || return 1
    export DEBIAN_FRONTEND=noninteractive
    apt-get install -y -qq --no-install-recommends "$@" >/dev/null 2>&1 && return
    apt-get update -qq >/dev/null 2>&1 &&
        apt-get install -y -qq --no-install-recommends "$@" >/dev/null 2>&1
}

python=${PYTHON:-python3}
command -v "$python" >/dev/null || apt_install python3 python3-venv ||
    { say "python3 is missing: apt-get install python3 python3-venv"; exit 1; }
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
    { say "Python 3.11 or later is needed, $python is $("$python" -V)"; exit 1; }
if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
    apt_install python3-venv || { say "venv is missing: apt-get install python3-venv"; exit 1; }
fi

[ -x .venv/bin/python ] && .venv/bin/python -m pip --version >/dev/null 2>&1 ||
    "$python" -m venv --clear .venv
.venv/bin/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'

found() { .venv/bin/python -c "import ctypes.util, sys; sys.exit(not ctypes.util.find_library('$1'))"; }
if ! found EGL && ! found OSMesa; then
    apt_install libegl1 libgl1-mesa-dri ||
        say "no EGL library, so no videos: as root, apt-get install libegl1 libgl1-mesa-dri"
fi

# what tests of the viewer and of the report look at; they are left out without
if ! command -v Xvfb >/dev/null || ! command -v xdotool >/dev/null; then
    apt_install xvfb xdotool libgl1 libglx-mesa0 libgl1-mesa-dri ||
        say "no Xvfb and xdotool, so the viewer is not tested"
fi
if ! command -v chromium >/dev/null; then
    apt_install chromium || say "no chromium, so the report is not opened in a test"
fi
