"""Scenes as MJCF that walk by themselves, without any code between their steps."""
