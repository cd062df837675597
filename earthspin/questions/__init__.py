"""Questions that a user can ask, one module each: class, parts of the computation, sections."""
