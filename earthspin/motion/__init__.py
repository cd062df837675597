"""Motion of a body's axes and of its full attitude in time, under external torques."""
