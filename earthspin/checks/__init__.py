"""Self-checks on request: error of methods against run time, and stiff or extreme test cases."""
