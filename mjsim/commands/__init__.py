"""Commands of the command line: one module each, and `undulator`, which calls them by name."""
