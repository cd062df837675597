"""Motion with no torque (I.2, I.4 to I.6)."""
