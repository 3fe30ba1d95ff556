"""Looks of a robot on its ground: models that are posed, and never stepped."""
