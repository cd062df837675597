"""What the package checks of itself on request: error against run time, stiff cases."""
