"""Ladders: for each quantity, the methods to compare, their settings and a reference solution."""
