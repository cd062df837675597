"""Mathematics without physics: elliptic functions, double-double, quaternions, Gauss windows."""
