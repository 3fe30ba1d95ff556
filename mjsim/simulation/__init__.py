"""Stepping a scene, and what comes out."""
