"""What a model looks like: skins, ground, lights, cameras, ruler."""
