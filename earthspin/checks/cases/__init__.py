"""Stiff and extreme test cases of the self-checks, one module for each part of the package."""
