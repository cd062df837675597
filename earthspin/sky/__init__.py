"""What others have computed or observed: kernels, IAU models, standstills of the Moon."""
