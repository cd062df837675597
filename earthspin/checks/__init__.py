"""How good it is: error against run time, and the stiff and extreme cases."""
