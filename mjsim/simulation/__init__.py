"""Stepping scenes in MuJoCo."""
