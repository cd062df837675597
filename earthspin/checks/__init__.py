"""Self-checks that users can run: error against run time of methods, and extreme test cases."""
