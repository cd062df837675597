"""Result of a fit of the free wobble: its period and quality factor."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class WobbleFit:
    """Period and quality factor of the free wobble, as fitted by one method.

    Attributes
    ----------
    method : str
    period, period_error : float
        Value and 95 % half-width, d.
    quality_factor : float
        Q.
    quality_bounds : tuple of float
        Ends of the 95 % interval of Q.
    """

    method: str
    period: float
    period_error: float
    quality_factor: float
    quality_bounds: tuple[float, float]
