"""Errors planted one at a time, to see that the suite catches every one of them."""
