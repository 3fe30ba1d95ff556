"""Videos and pictures of a walk."""
