"""Spin axis of a body over millennia to millions of years, by averaged torques."""
