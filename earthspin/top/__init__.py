"""The heavy symmetric top, spinning about a fixed point of its axis (I.7)."""
