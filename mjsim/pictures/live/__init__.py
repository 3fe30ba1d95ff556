"""The live viewer: a walk that goes on, with a slider per chamber."""
