"""Our pole beside the IAU's."""
