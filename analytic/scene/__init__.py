"""The scene as plain data: robots, pneu-nets, chains of links, gaits, surfaces and grounds."""
