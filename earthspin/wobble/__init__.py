"""The free wobble, from a rigid Earth to the observed one."""
