"""Models and observation of the free wobble."""
