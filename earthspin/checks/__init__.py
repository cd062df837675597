"""Self-checks on request: ladders of error against run time, and stiff and extreme cases."""
