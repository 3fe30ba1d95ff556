"""MuJoCo models of the strip: one module a body."""
