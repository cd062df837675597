"""What the axis then does: its path in time under the torques."""
