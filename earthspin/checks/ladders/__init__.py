"""Comparisons of methods (ladders): their settings and a reference solution, for each quantity."""
