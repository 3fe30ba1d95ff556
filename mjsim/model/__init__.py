"""Scenes as MuJoCo models: bodies, ground, chambers, files that walk by themselves."""
