"""Numerical methods: elliptic functions, 32-digit numbers, quaternions, Gauss quadrature."""
