"""The heavy symmetric top, which rotates about a fixed point on its axis under its weight (I.7)."""
