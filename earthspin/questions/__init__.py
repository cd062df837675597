"""One module for each question that a user can ask, such as the precession rate of a body."""
