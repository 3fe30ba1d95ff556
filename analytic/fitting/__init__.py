"""Numbers of an actuator from what a bench measured."""
