"""The stiff and extreme cases, by part of the package."""
