"""What lies under the surface: layers, Love numbers, the figure of equilibrium."""
