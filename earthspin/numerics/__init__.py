"""Numerical methods: elliptic functions, double-double numbers, quaternions, Gauss windows."""
