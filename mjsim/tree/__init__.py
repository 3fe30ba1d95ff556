"""Robots of several pneu-nets in space, such as the quadruped, in MuJoCo."""
