"""One ladder per quantity: its methods, their settings, and the reference."""
