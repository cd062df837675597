"""Questions: one module each, with its class, parts and sections."""
