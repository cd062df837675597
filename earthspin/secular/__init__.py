"""Spin axis over millennia to millions of years: averaged torques on a changing orbit."""
