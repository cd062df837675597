"""Torques by Sun, Moon and planets on the equatorial bulge (I.8)."""
