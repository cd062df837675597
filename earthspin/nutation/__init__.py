"""Compare the precession and nutation of computed poles with the IAU models."""
