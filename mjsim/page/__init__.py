"""One page about some walks, in one file."""
