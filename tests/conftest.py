import os

from hypothesis import HealthCheck, settings

from mjsim.video import gl

settings.register_profile(
    "project", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("project")

# decided once, before any test imports mujoco
BACKEND = gl.find_backend()
os.environ[gl.VARIABLE] = BACKEND or gl.NONE
