"""Precession and nutation compared with the IAU models: analysis, response, angles, budget."""
