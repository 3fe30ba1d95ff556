"""Walks of many strips stepped side by side by mujoco.batch.Batch."""
