"""Motion of the axes and of the attitude of a body in time, under torques."""
