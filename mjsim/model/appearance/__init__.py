"""Looks of a model: skins, ground, lights, cameras, ruler."""
