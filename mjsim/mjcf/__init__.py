"""The robot on its ground as MJCF."""
