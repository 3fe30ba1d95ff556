"""Unknown fields of a scene, and the interval of its distance for that."""
