"""The heavy symmetric top, spinning about a fixed point on its axis (I.7)."""
