import os
import signal

import pytest
from hypothesis import HealthCheck, settings

from analytic.friction.laws import LAWS
from mjsim.pictures import gl
from mjsim.scene import registry

settings.register_profile(
    "project", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("project")

# what runs in the background inherits that Ctrl-C is ignored, and so would all that tests start
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# decided once, before any test imports mujoco
BACKEND = gl.find_backend()
os.environ[gl.VARIABLE] = BACKEND or gl.NONE


@pytest.fixture
def forgets(monkeypatch):
    """Forget after a test what it registers."""
    for names in (LAWS, registry.BODIES):
        monkeypatch.setattr(names, "_registered", names.registered)


@pytest.fixture
def coarse(monkeypatch):
    """Coarse references, for tests whose claim is no digit of them."""
    from walks import coarsen

    coarsen(monkeypatch)
