"""The free wobble in observed polar motion: period, quality factor, amplitude in time.

Polar motion is complex, p = x - i y, so that the free wobble turns with exp(+i omega t).
Three ways to its period:

- Burg: an autoregressive model of block means; the pole nearest to the wobble gives
  period and quality factor. Milliseconds, no starting values.
- likelihood: a damped oscillator driven by noise, a red background and seasonal terms
  together, by maximum likelihood; errors from the likelihood itself.
- least squares: a sinusoid of fixed size. A quick look: a driven wobble is no sinusoid,
  so it says nothing about the quality factor, and its error comes from the scatter that a
  driven wobble of a usual quality factor would have.

An oscillator that is driven at random and observed over a span L tells its frequency no
better than sqrt(T/(4 pi Q L)) of itself, however well it is measured; formal errors from
white noise are tens of times smaller and wrong.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky_banded, solve_banded
from scipy.optimize import brentq, minimize
from scipy.signal import lfilter

from earthspin.constants import NORMAL_95
from earthspin.errors import UndefinedError

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

YEAR = 365.2422  # d, the tropical year of the seasons
#: Seasonal terms that are fitted and removed, d; negative ones turn backwards.
SEASONS = (YEAR, -YEAR, YEAR / 2, -YEAR / 2)
#: Periods among which the free wobble is looked for, d.
BAND = (400.0, 470.0)
#: Where the search starts, d.
NEAR = 433.0
#: Degree of the slow drift.
DRIFT = 3

BURG_BLOCK = 30.0  # d
BURG_ORDER = 12
LIKELIHOOD_BLOCK = 120.0  # d
BACKGROUND_TIME = 365.0  # d, memory of the red background

#: How far the scatter of Burg's periods exceeds the best possible one, from simulations.
BURG_EXCESS = 1.2
#: The same of Burg's decay, downwards and upwards: noise makes it too fast rather than too slow.
BURG_DECAY_EXCESS = (1.6, 0.6)
#: How far amplitudes scatter beyond the noise that is left in a window, from simulations: the
#: fit takes some of it away.
AMPLITUDE_EXCESS = 1.3
#: Quality factor that stands for the unknown one where a method gives none.
USUAL_Q = 100.0


@dataclass(frozen=True)
class WobbleFit:
    """Period and quality factor of the free wobble.

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
        """Q."""
        return self._known()[0]

    @property
    def quality_bounds(self) -> tuple[float, float]:
        """Ends of the 95 % interval of Q."""
        _, low, high = self._known()
        return low, high

    @property
    def gives_quality(self) -> bool:
        """Whether the method says anything about Q."""
        return self._quality is not None

    def _known(self) -> tuple[float, ...]:
        if self._quality is None:
            raise UndefinedError(
                f"{self.method} gives no quality factor: it takes the wobble for a sinusoid of "
                "fixed size; use method 'burg' or 'likelihood'"
            )
        return self._quality


def shortest_span(period: float = NEAR) -> float:
    """Days that are needed to tell the free wobble from the annual one: one beat of the two."""
    return 1 / (1 / YEAR - 1 / period)


def fit(time: Array, p: Complex, method: str = "burg") -> WobbleFit:
    """Find the free wobble by one of the methods.

    Parameters
    ----------
    time : array, shape (n,)
        d, evenly spaced.
    p : complex array, shape (n,)
        x - i y in any unit.
    method : str
        ``"burg"``, ``"likelihood"`` or ``"least-squares"``.

    Raises
    ------
    UndefinedError
        If the method is unknown, the span is too short, or there is no wobble.
    """
    if method not in METHODS:
        raise UndefinedError(f"method {method!r} is unknown; allowed: {', '.join(METHODS)}")
    _check(time, p)
    return METHODS[method](np.asarray(time, dtype=float), np.asarray(p, dtype=complex))


def _check(time: Array, p: Complex) -> None:
    """Refuse what no method can use."""
    if np.shape(time) != np.shape(p) or np.ndim(p) != 1:
        raise UndefinedError(f"{np.shape(time)} times for {np.shape(p)} positions; give as many")
    if not (np.all(np.isfinite(time)) and np.all(np.isfinite(p))):
        raise UndefinedError("polar motion has values that are no numbers; leave those days out")
    steps = np.diff(time)
    if steps.size == 0 or np.any(abs(steps - steps.mean()) > 1e-3 * abs(steps.mean())):
        raise UndefinedError("times are not evenly spaced; fill the gaps or take another span")
    if not 0 < steps.mean() <= BURG_BLOCK:
        raise UndefinedError(
            f"a step of {steps.mean():.3g} d is not possible; it lies between 0 and "
            f"{BURG_BLOCK:g} d"
        )
    span, needed = time[-1] - time[0], 2 * shortest_span()
    if span < needed:
        raise UndefinedError(
            f"a span of {span / 365.25:.1f} years is too short to separate {YEAR:.0f} from "
            f"{NEAR:.0f} days; it takes {needed / 365.25:.0f} years, two beats of the two wobbles"
        )


# --- what is not free wobble -------------------------------------------------------------------


def known_terms(time: Array, drift: int = DRIFT) -> Complex:
    """Columns of drift and seasonal terms, shape (n, drift + 5)."""
    centre, half = (time[-1] + time[0]) / 2, (time[-1] - time[0]) / 2
    scaled = (time - centre) / half
    return np.column_stack(
        [scaled**k for k in range(drift + 1)] + [_turning(time, period) for period in SEASONS]
    ).astype(complex)


def _turning(time: Any, period: float) -> Complex:
    return np.asarray(np.exp(2j * np.pi * time / period))


def block_means(values: Any, size: int) -> Any:
    """Means of consecutive blocks along the first axis; what is left over is dropped."""
    count = len(values) // size
    return values[: count * size].reshape(count, size, *values.shape[1:]).mean(axis=1)


def in_blocks(time: Array, p: Complex, length: float) -> tuple[Array, Complex, float]:
    """Means over blocks of about a length in days, and the spacing that they have.

    A sinusoid stays one and is shortened by sinc(block/T).
    """
    step = (time[-1] - time[0]) / (time.size - 1)
    size = max(1, round(length / step))
    return block_means(time, size), block_means(p, size), size * float(step)


def least_squares(columns: Complex, values: Complex) -> Complex:
    """Coefficients of the columns."""
    return np.asarray(np.linalg.lstsq(columns, values, rcond=None)[0])


def without_known_terms(time: Array, p: Complex, period: float = NEAR) -> Complex:
    """Polar motion less drift and seasons, fitted together with a wobble that stays."""
    columns = known_terms(time)
    found = least_squares(np.column_stack([columns, _turning(time, period)]), p)
    return np.asarray(p - columns @ found[:-1])


# --- Burg --------------------------------------------------------------------------------------


def burg(x: Complex, order: int) -> Complex:
    """Prediction-error filter 1, a1, ..., by Burg's method for complex series.

    Forward and backward errors are shortened by reflection coefficients of least mean
    error (Burg 1967; Marple 1987, Digital Spectral Analysis, sect. 8.5).

    Parameters
    ----------
    x : complex array
        Of mean zero.
    order : int
    """
    forward, backward = x[1:], x[:-1]
    filter_ = np.ones(1, dtype=complex)
    for _ in range(order):
        power = np.vdot(forward, forward).real + np.vdot(backward, backward).real
        reflection = -2 * np.vdot(backward, forward) / power
        longer = np.append(filter_, 0)
        filter_ = longer + reflection * longer[::-1].conj()
        forward, backward = (
            (forward + reflection * backward)[1:],
            (backward + np.conj(reflection) * forward)[:-1],
        )
    return filter_


def fit_burg(time: Array, p: Complex) -> WobbleFit:
    """Pole of an autoregressive model of monthly means, after drift and seasons."""
    span = time[-1] - time[0]
    time, p, step = in_blocks(time, p, BURG_BLOCK)
    poles = np.roots(burg(without_known_terms(time, p), BURG_ORDER))
    s = np.log(poles) / (1j * step)
    inside = s[(s.real > 2 * np.pi / BAND[1]) & (s.real < 2 * np.pi / BAND[0])]
    if inside.size == 0:
        raise UndefinedError(
            f"no free wobble between {BAND[0]:.0f} and {BAND[1]:.0f} d stands out; take a longer "
            "or quieter span"
        )
    wobble = inside[np.argmin(abs(inside.imag))]
    period, decay = 2 * np.pi / wobble.real, abs(wobble.imag)
    error = BURG_EXCESS * period * np.sqrt(decay / span) / wobble.real
    low, high = _decay_interval(decay, span)
    quality = tuple(float(wobble.real / (2 * v)) for v in (decay, high, low))
    return WobbleFit("burg", float(period), float(NORMAL_95 * error), quality)


def _decay_interval(decay: float, span: float) -> tuple[float, float]:
    """95 % interval of the decay d: all from which the found one is within 1.96 sqrt(d/span)."""
    low, high = ((NORMAL_95 * excess) ** 2 / span for excess in BURG_DECAY_EXCESS)
    return (
        float(decay + low / 2 - np.sqrt(decay * low + low**2 / 4)),
        float(decay + high / 2 + np.sqrt(decay * high + high**2 / 4)),
    )


# --- maximum likelihood --------------------------------------------------------------------------


class _Likelihood:
    """Likelihood of a driven wobble, a red background and known terms, in block means.

    Series and columns are turned back by the expected wobble before they are averaged, so
    that the wobble stands nearly still in blocks of months. What is known is integrated
    out (restricted likelihood, Patterson & Thompson 1971, Biometrika 58, 545), the scale of
    all power as well.

    Both processes are autoregressive of first order, x_k = a x_(k-1) + kick. The sum of
    two, less (a + b) of its last and plus a b of its last but one, is correlated with its
    neighbour alone: the covariance has three diagonals, and the likelihood takes a time
    in proportion to the number of blocks.
    """

    def __init__(self, time: Array, p: Complex) -> None:
        time, p, step = in_blocks(time, p, BURG_BLOCK / 3)
        size = max(1, round(LIKELIHOOD_BLOCK / step))
        back = _turning(time, -NEAR)
        self.data = block_means(np.column_stack([known_terms(time), p]) * back[:, None], size)
        self.step = size * step
        self.free = len(self.data) - self.data.shape[1] + 1

    def __call__(self, rate: float, log_decay: float, log_background: float) -> float:
        """Minus twice the logarithm of the likelihood.

        Parameters
        ----------
        rate : float
            Frequency less that of `NEAR`, rad/d.
        log_decay : float
            Logarithm of the decay, 1/d.
        log_background : float
            Logarithm of the background's power over what drives the wobble in a year.
        """
        decay = np.exp(log_decay)
        a = np.exp((1j * rate - decay) * self.step)
        b = np.exp((-2j * np.pi / NEAR - 1 / BACKGROUND_TIME) * self.step)
        power = np.array([1 / (2 * decay * YEAR), np.exp(log_background)])
        kicks = power * (1 - abs(np.array([a, b])) ** 2)
        diagonals = np.empty((2, len(self.data)), dtype=complex)
        diagonals[0, :2] = power.sum()
        diagonals[0, 2:] = kicks @ [1 + abs(b) ** 2, 1 + abs(a) ** 2]
        diagonals[1, 0], diagonals[1, 1:] = power @ [a, b], -kicks @ [b, a]
        lower = cholesky_banded(diagonals, lower=True, check_finite=False)
        short = self.data.copy()
        short[2:] += -(a + b) * self.data[1:-1] + a * b * self.data[:-2]
        white = solve_banded((1, 0), lower, short, check_finite=False)
        # The last diagonal element of R is the length of what the columns do not explain.
        triangle = abs(np.diag(np.linalg.qr(white, mode="r")))
        return float(
            2 * self.free * np.log(triangle[-1])
            + 2 * np.log(lower[0].real).sum()
            + 2 * np.log(triangle[:-1]).sum()
        )


def fit_likelihood(time: Array, p: Complex) -> WobbleFit:
    """Maximum likelihood, with errors where it falls by half the 95 % point of chi-squared."""
    likelihood = _Likelihood(time, p)
    unit = np.array([1e-4, 1.0, 1.0])
    start = np.array([0.0, np.log(2 * np.pi / NEAR / (2 * USUAL_Q)), -2.0])
    edge = 2 * np.pi / BAND[0] - 2 * np.pi / NEAR
    limits = [(-edge, edge), (-13.5, -5.0), (-8.0, 5.0)]
    best = minimize(
        lambda z: likelihood(*(z * unit)),
        start / unit,
        method="L-BFGS-B",
        bounds=[(low / u, high / u) for (low, high), u in zip(limits, unit, strict=True)],
        options={"ftol": 1e-10},
    )
    at = best.x * unit
    rates = _fall(lambda v: likelihood(v, at[1], at[2]), at[0], 2e-5, limits[0], best.fun)
    decays = _fall(lambda v: likelihood(at[0], v, at[2]), at[1], 0.3, limits[1], best.fun)
    rate = 2 * np.pi / NEAR + at[0]
    period = 2 * np.pi / rate
    ends = [2 * np.pi / (2 * np.pi / NEAR + r) for r in rates]
    slowest, fastest = np.exp(decays)
    if decays[0] == limits[1][0]:  # even a wobble without any loss is likely enough
        slowest = 0.0
    with np.errstate(divide="ignore"):
        quality = tuple(float(v) for v in np.divide(rate / 2, [np.exp(at[1]), fastest, slowest]))
    return WobbleFit("likelihood", float(period), float(abs(ends[1] - ends[0]) / 2), quality)


def _fall(
    of: Callable[[float], float],
    best: float,
    step: float,
    limits: tuple[float, float],
    least: float,
) -> tuple[float, float]:
    """Where a function has risen by the 95 % point of chi-squared on either side of its least.

    A limit stands for an end that lies beyond it.
    """
    target = least + NORMAL_95**2
    ends = []
    for sign, limit in ((-1.0, limits[0]), (1.0, limits[1])):
        room, reach = abs(limit - best), step
        while reach < room and of(best + sign * reach) < target:
            reach *= 2
        far = best + sign * min(reach, room)
        if of(far) <= target:
            ends.append(limit)
        else:
            ends.append(brentq(lambda v: of(v) - target, best, far, xtol=1e-3 * step))
    return ends[0], ends[1]


# --- least squares -------------------------------------------------------------------------------


def fit_least_squares(time: Array, p: Complex) -> WobbleFit:
    """The sinusoid that explains most, beside drift and seasons."""
    span = time[-1] - time[0]
    t, means, _ = in_blocks(time, p, BURG_BLOCK)
    columns = np.linalg.qr(known_terms(t))[0]
    rest = means - columns @ (columns.conj().T @ means)

    def explained(period: Array) -> Array:
        """Power of the sinusoids less what drift and seasons hold of them."""
        waves = np.exp(2j * np.pi * t[:, None] / period)
        waves = waves - columns @ (columns.conj().T @ waves)
        return np.asarray(abs(waves.conj().T @ rest) ** 2 / np.sum(abs(waves) ** 2, axis=0))

    coarse = np.linspace(*BAND, 71)
    centre = coarse[np.argmax(explained(coarse))]
    fine = np.linspace(centre - 1, centre + 1, 41)
    period = float(fine[np.argmax(explained(fine))])
    # A driven wobble wanders in phase; over a span L this shifts the best sinusoid by
    # 2.4 times the best possible scatter, from simulations.
    error = 2.4 * period * np.sqrt(period / (4 * np.pi * USUAL_Q * span))
    return WobbleFit("least-squares", period, float(NORMAL_95 * error))


METHODS: dict[str, Callable[[Array, Complex], WobbleFit]] = {
    "burg": fit_burg,
    "likelihood": fit_likelihood,
    "least-squares": fit_least_squares,
}


# --- amplitude in time ---------------------------------------------------------------------------


@dataclass(frozen=True)
class Envelope:
    """Wobbles in sliding windows.

    Attributes
    ----------
    time : array, shape (w,)
        Middles of the windows, d.
    chandler, annual, annual_retrograde : complex array
        Sizes and phases at time 0: terms a exp(2 pi i time/T).
    error : array
        95 % half-width of the amplitudes.
    drift : complex array
        Mean position in the window.
    """

    time: Array
    chandler: Complex
    annual: Complex
    annual_retrograde: Complex
    drift: Complex
    error: Array


def envelope(
    time: Array, p: Complex, period: float, window: float | None = None, step: float = 30.0
) -> Envelope:
    """Fit both wobbles and a line in sliding windows.

    Parameters
    ----------
    time : array
        d, evenly spaced.
    p : complex array
    period : float
        Of the free wobble, d.
    window : float, optional
        Length, d; one beat of the two wobbles by default, the shortest that parts them.
    step : float
        Between windows, d.

    Raises
    ------
    UndefinedError
        If the window is shorter than a beat, or longer than the series.
    """
    beat = shortest_span(period)
    length = beat if window is None else window
    time, p, spacing = in_blocks(time, p, BURG_BLOCK)
    size = round(length / spacing) + 1
    if length < 0.9 * beat or size > time.size:
        raise UndefinedError(
            f"a window of {length:.0f} d is not possible; it lies between one beat of the wobbles, "
            f"{beat:.0f} d, and the series' {time[-1] - time[0]:.0f} d"
        )
    local = (np.arange(size) - (size - 1) / 2) * spacing
    terms = (period, YEAR, -YEAR, YEAR / 2)
    # A mean over a block shortens a sinusoid by sinc(block/T).
    waves = [_turning(local, term) * np.sinc(spacing / term) for term in terms]
    columns = np.column_stack([np.ones(size), local / length, *waves])
    solver = np.linalg.pinv(columns)
    starts = np.arange(0, time.size - size + 1, max(1, round(step / spacing)))
    series = np.lib.stride_tricks.sliding_window_view(p, size)[starts]
    found = series @ solver.T
    middle = time[starts] + local[-1]
    left = series - found @ columns.T
    back = np.exp(-2j * np.pi * middle[:, None] / np.array(terms[:3]))
    turned = found[:, 2:5] * back
    return Envelope(
        middle,
        turned[:, 0],
        turned[:, 1],
        turned[:, 2],
        found[:, 0],
        _amplitude_error(left, spacing, 2 * np.pi / period),
    )


def _amplitude_error(left: Complex, spacing: float, rate: float) -> Array:
    """Half-width of an amplitude from what is left in its window, which is not white.

    Neighbouring months err alike: the noise is taken for an autoregressive one of first
    order, and its spectrum read off at the wobble's frequency.
    """
    power = np.mean(abs(left) ** 2, axis=1)
    alike = np.mean(left[:, 1:] * left[:, :-1].conj(), axis=1) / power
    turned = abs(1 - alike * np.exp(-1j * rate * spacing)) ** 2
    density = power * (1 - abs(alike) ** 2) / turned
    return np.asarray(AMPLITUDE_EXCESS * NORMAL_95 * np.sqrt(density / (2 * left.shape[1])))


# --- spectrum ------------------------------------------------------------------------------------


def spectrum(time: Array, p: Complex) -> tuple[Array, Array]:
    """Amplitude spectrum, prograde and retrograde apart.

    Parameters
    ----------
    time : array
        d, evenly spaced.
    p : complex array
        In any unit; a cubic drift is removed and a Hann window applied.

    Returns
    -------
    frequency : array
        Cycles per year of 365.25 d, ascending; negative is retrograde.
    amplitude : array
        Of a sinusoid that stands alone, in the unit of p.
    """
    step = (time[-1] - time[0]) / (time.size - 1)
    scaled = np.linspace(-1, 1, time.size)
    drift = np.column_stack([scaled**k for k in range(DRIFT + 1)]).astype(complex)
    rest = p - drift @ least_squares(drift, p)
    taper = np.hanning(time.size)
    padded = 4 * time.size
    amplitude = abs(np.fft.fftshift(np.fft.fft(rest * taper, padded))) / taper.sum()
    frequency = np.fft.fftshift(np.fft.fftfreq(padded, step)) * 365.25
    return frequency, amplitude


# --- simulation ----------------------------------------------------------------------------------


def simulate(
    years: float,
    period: float = NEAR,
    quality_factor: float = USUAL_Q,
    *,
    step: float = 10.0,
    amplitude: float = 128.0,
    seed: int | None = None,
) -> tuple[Array, Complex]:
    """A driven wobble with seasons, drift and background, to put the methods to the test.

    Parameters
    ----------
    years : float
        Of 365.25 d.
    period, quality_factor : float
        Of the free wobble; d.
    step : float
        d.
    amplitude : float
        Root mean square of the wobble, mas.
    seed : int, optional

    Returns
    -------
    time : array
        d.
    p : complex array
        mas. The background's level is that of the observed motion.
    """
    generator = np.random.default_rng(seed)
    time = np.arange(0.0, years * 365.25, step)

    def process(rate: complex, size: float) -> Complex:
        """Stationary complex process with covariance size2 exp(rate |lag|)."""
        kick = generator.standard_normal((time.size, 2)) @ np.array([1, 1j]) / np.sqrt(2)
        keep = np.exp(rate * step)
        kick[1:] *= np.sqrt(1 - abs(keep) ** 2)
        return np.asarray(size * lfilter([1.0], [1.0, -keep], kick))

    rate = 2 * np.pi / period
    p = process(1j * rate - rate / (2 * quality_factor), amplitude)
    p += process(-1 / BACKGROUND_TIME, 0.08 * amplitude) + process(-1 / 15.0, 0.06 * amplitude)
    p += 94 * _turning(time, YEAR) + 4.5 * _turning(time, -YEAR) + 5 * _turning(time, YEAR / 2)
    return time, p + (30 - 300j) + (1.6 - 3.4j) * time / 365.25
