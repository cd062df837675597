"""Ladders of error against run time, one module per quantity: methods, settings, reference."""
