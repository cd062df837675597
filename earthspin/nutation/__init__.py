"""Precession and nutation beside the IAU's: analysis, response, angles, budget."""
