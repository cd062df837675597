"""Positions and orbits of bodies, directions of poles, IAU models, and observed Earth rotation."""
