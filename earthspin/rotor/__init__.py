"""Torque-free rotation of rigid bodies (I.2, I.4 to I.6)."""
