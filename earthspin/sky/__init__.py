"""Kernels, IAU models, observed Earth rotation, orbit tables, and lunar standstills."""
