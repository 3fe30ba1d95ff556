"""What is typed: one module a command, and `undulator`, which calls them by name."""
