"""How mass is spread: inertia, multipoles, spheroids (I.1, I.3, I.9)."""
