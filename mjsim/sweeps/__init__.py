"""Many scenes: a plan, workers that walk them, and a file that survives a crash."""
