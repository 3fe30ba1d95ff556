"""Robots of several pneu-nets in space: limbs, their kinematics, statics on the ground, walks."""
