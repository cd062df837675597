"""Mass distributions: inertia, principal axes, multipoles, spheroids (I.1, I.3, I.9)."""
