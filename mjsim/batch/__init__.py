"""Many scenes of one layout, stepped side by side by mujoco.batch.Batch."""
