"""Fields of a scene from measurements: what was measured, what is free, least squares."""
