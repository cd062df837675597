"""Result of a fit of the free wobble: its period and quality factor."""

from __future__ import annotations

from dataclasses import dataclass

from earthspin.errors import UndefinedError


@dataclass(frozen=True)
class WobbleFit:
    """Period and quality factor of the free wobble, as fitted by one method.

    Attributes
    ----------
    method : str
    period, period_error : float
        Value and 95 % half-width, d.
    """

    method: str
    period: float
    period_error: float
    _quality: tuple[float, ...] | None = None

    @property
    def quality_factor(self) -> float:
        """Quality factor Q of the free wobble."""
        return self._known()[0]

    @property
    def quality_bounds(self) -> tuple[float, float]:
        """Ends of the 95 % interval of Q."""
        _, low, high = self._known()
        return low, high

    @property
    def gives_quality(self) -> bool:
        """Return True if the fit gives an estimate of the quality factor Q."""
        return self._quality is not None

    def _known(self) -> tuple[float, ...]:
        if self._quality is None:
            raise UndefinedError(
                f"{self.method} gives no quality factor: it takes the wobble for a sinusoid of "
                "fixed size; use method 'burg' or 'likelihood'"
            )
        return self._quality
