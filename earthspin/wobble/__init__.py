"""Models of the free wobble, and its period and quality factor from observations."""
