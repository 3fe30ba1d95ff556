"""MuJoCo replication of the undulating pneumatic strip, checked against `analytic`."""

from mjsim.video import gl

gl.set_default_backend()  # before anything imports mujoco, which reads MUJOCO_GL once
