"""The short calls: each builds a scene and runs it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from earthspin import storage
from earthspin.bodies import Body
from earthspin.errors import SceneError
from earthspin.progress import progress
from earthspin.scene.running import BLOCK, run, run_blocks, series_length
from earthspin.scene.spec import Scene, load_scene

if TYPE_CHECKING:
    import xarray as xr

Perturbers = Sequence[Body | str]


def precession(
    *,
    body: Body | str = "earth",
    perturbers: Perturbers = ("sun", "moon"),
    ephemeris: Any = "de421",
    span: tuple[Any, Any] | None = None,
    accuracy: float | None = None,
) -> xr.Dataset:
    """Rate and period of precession from torques averaged over orbits (I.8).

    Parameters
    ----------
    body : Body or str
        What spins; numeric fields may be labelled arrays.
    perturbers : sequence of Body or str
        What pulls on it.
    ephemeris : str, path or Skyfield kernel
    span : pair of dates, optional
        TDB; all that the kernel covers by default.
    accuracy : float, optional
        Largest relative error of the rate by all perturbers that is allowed; the cheapest
        settings that keep it are chosen.

    Returns
    -------
    Dataset
        Along `perturber`: `precession_rate` (arcsec/yr), `precession_period` (yr) and
        `mean_torque` (N m), each with its 95 % half-width `_error`, referred to
        `reference_epoch`; the models of the figure, the free wobble, the comparison with
        IAU 2006 and the lunar standstills, as far as they apply; the plan along `part`.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.

    Examples
    --------
    >>> import earthspin
    >>> result = earthspin.precession()
    >>> print(result.precession_period.round().values)
    [81260. 37614. 25712.]
    """
    return run(
        Scene(
            compute="precession",
            body=body,
            perturbers=perturbers,
            ephemeris=ephemeris,
            span=span,
            accuracy=accuracy,
        )
    )


def torque_series(
    start: Any = None,
    stop: Any = None,
    step: Any = None,
    *,
    times: Any = None,
    body: Body | str = "earth",
    perturbers: Perturbers = ("sun", "moon"),
    equator: str = "mean",
    ephemeris: Any = "de421",
    accuracy: Any = None,
) -> xr.Dataset:
    """Declination, distance and torque of each perturber in time (I.8.7).

    Parameters
    ----------
    start, stop : date
        Text, datetime, datetime64 or Time; plain dates mean TDB. The end is included if
        the step meets it.
    step : duration
        Text such as ``"6 h"``, Quantity, timedelta, or seconds.
    times : Time or array of dates
        Instead of the three, the very times that are wanted.
    body : Body or str
        What is pulled.
    perturbers : sequence of Body or str
        What pulls.
    equator : str
        Axes: ``"mean"`` or ``"true"`` equator and equinox of date.
    ephemeris : str, path or Skyfield kernel
    accuracy : angle, optional
        Largest error of a direction that is allowed, such as ``"1 mas"``; the cheapest
        settings that keep it are chosen.

    Returns
    -------
    Dataset
        Over `time` and `perturber`: `right_ascension`, `declination` (deg), `distance` (m),
        `torque` (N m, `component` x, y, z), `torque_magnitude` and its error.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.
    """
    _check_times(start, stop, step, times)
    return run(
        Scene(
            compute="torque",
            body=body,
            perturbers=perturbers,
            equator=equator,
            ephemeris=ephemeris,
            accuracy=accuracy,
            span=None if start is None else (start, stop),
            step=step,
            times=times,
        )
    )


def _check_times(start: Any, stop: Any, step: Any, times: Any) -> None:
    """Either all three or none; and not together with times."""
    given = {"start": start, "stop": stop, "step": step}
    if times is None:
        missing = [name for name, value in given.items() if value is None]
        if missing and len(missing) < 3:
            raise SceneError(missing[0], None, "give start, stop and step, or times")
    elif any(value is not None for value in given.values()):
        raise SceneError("times", "...", "give either times, or start, stop and step")


def pole(
    start: Any = None,
    stop: Any = None,
    step: Any = None,
    *,
    times: Any = None,
    body: Body | str = "earth",
    perturbers: Perturbers = ("sun", "moon"),
    effects: Sequence[str] | None = None,
    ephemeris: Any = "de421",
    accuracy: Any = None,
) -> xr.Dataset:
    """Path of the axes under the torques, in the GCRS.

    Parameters
    ----------
    start, stop : date
        Text, datetime, datetime64 or Time; plain dates mean TDB. The end is included if
        the step meets it. By default 1980 to 2020 in steps of 5 d.
    step : duration
        Text such as ``"6 h"``, Quantity, timedelta, or seconds.
    times : Time or array of dates
        Instead of the three, the very times that are wanted.
    body : Body or str
        What spins. It starts from its pole at J2000.0; the Earth from that of IAU 2006/2000A.
    perturbers : sequence of Body or str
        What pulls.
    effects : sequence of str, optional
        Of ``planets``, ``j3``, ``j4``, ``triaxiality``, ``geodesic``, ``j2-rate``,
        ``second-order``, ``nonrigid``; all but the last by default. ``geodesic`` needs the Sun
        among the perturbers; it turns a sphere, too.
    ephemeris : str, path or Skyfield kernel
    accuracy : angle, optional
        Largest error of a direction that is allowed, such as ``"1 mas"``; the cheapest
        settings that keep it are chosen.

    Returns
    -------
    Dataset
        Over `time` and `axis` (``angular_momentum``, ``rotation``, ``figure``): `X`, `Y`, `Z`
        (unit vectors), `psi` and `eps` (arcsec, on the fixed orbit of J2000.0) where they are
        defined; over `time` `direction_error` (uas).

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line; among it a spin that is too slow.
    """
    _check_times(start, stop, step, times)
    return run(
        Scene(
            compute="pole",
            body=body,
            perturbers=perturbers,
            effects=effects,
            ephemeris=ephemeris,
            accuracy=accuracy,
            span=None if start is None else (start, stop),
            step=step,
            times=times,
        )
    )


def compare_iau(
    start: Any = None,
    stop: Any = None,
    step: Any = None,
    *,
    times: Any = None,
    perturbers: Perturbers = ("sun", "moon"),
    effects: Sequence[str] | None = None,
    ephemeris: Any = "de421",
) -> xr.Dataset:
    """Our pole beside that of IAU 2006/2000A: budget, residuals, nutations, angles.

    Parameters
    ----------
    start, stop, step : date, date, duration
        Where residuals are wanted; 1980 to 2020 in steps of 5 d by default.
    times : Time or array of dates
        Instead of the three, the very times that are wanted.
    perturbers : sequence of Body or str
        What pulls.
    effects : sequence of str, optional
        As for `pole`.
    ephemeris : str, path or Skyfield kernel

    Returns
    -------
    Dataset
        Over `effect`: `psi_rate`, `psi_rate_published`, `omega_rate` (arcsec/yr, at J2000.0);
        `closure` (arcsec/yr), after the published non-linear term; over `time`:
        `dpsi_sineps`, `deps` (mas); the nutation table over `term`, the free core nutation,
        the angles of precession over `angle`, and H and C as the IAU's rate implies them.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.
    """
    _check_times(start, stop, step, times)
    return run(
        Scene(
            compute="iau",
            perturbers=perturbers,
            effects=effects,
            ephemeris=ephemeris,
            span=None if start is None else (start, stop),
            step=step,
            times=times,
        )
    )


def write_series(scene: Scene | str | Path, path: str | Path) -> Path:
    """Write a torque series of any length to chunked Zarr, in bounded memory.

    Parameters
    ----------
    scene : Scene, str or Path
        One that computes ``torque``.
    path : str or Path
        The Zarr folder; what is there is replaced when all is written.

    Returns
    -------
    Path

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line; nothing is left behind then.
    """
    scene = scene if isinstance(scene, Scene) else load_scene(scene)
    size = series_length(scene)
    if size == 0:
        raise SceneError("compute", scene.compute, "only a torque series is written by region")
    with progress("torque series", size) as advance:

        def blocks() -> Any:
            for block in run_blocks(scene):
                yield block
                advance(min(BLOCK, block.sizes["time"]))

        return storage.write_blocks(blocks(), path)


def wobble_ladder(
    *, body: Body | str = "earth", ocean: str = "real", anelastic_exponent: float | None = None
) -> xr.Dataset:
    """Period of the free wobble, from a formula of flattening to a body that yields (I.6).

    Parameters
    ----------
    body : Body or str
        Its `interior` says how far the ladder goes.
    ocean : str
        ``"real"``, ``"global"`` or ``"none"``.
    anelastic_exponent : float, optional
        Of the mantle's loss; 0.09 by default.

    Returns
    -------
    Dataset
        Along `rung` (flattening, rigid, triaxial, elastic, fluid-core, ocean, anelastic):
        `period_solar` (d of 86400 s) with its 95 % half-width, `period_sidereal`, `factor`,
        `quality_factor`; apart, `observed_period`. Along `input`: what the last rung depends
        on. The free core nutation, by the shape of the core.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.

    Examples
    --------
    >>> import earthspin
    >>> print(earthspin.wobble_ladder().period_solar.round(1).values)
    [297.4 303.6 303.6 444.4 393.9 423.7 431.6]
    """
    settings: dict[str, Any] = {"ocean": ocean}
    if anelastic_exponent is not None:
        settings["anelastic_exponent"] = anelastic_exponent
    return run(Scene(compute="wobble", body=body, tables={"wobble": settings}))


def free_rotor(
    moments: Any, omega: Any, times: Any, *, accuracy: float | None = None
) -> xr.Dataset:
    """Motion of a body without torque, in closed form (I.4 to I.6).

    Parameters
    ----------
    moments : sequence of three, or mapping
        Principal moments about the x, y, z axes of the body, in any order of size, kg m2; or
        ``{"A": ..., "B-A": ..., "C-A": ...}``, so that no digits are lost.
    omega : sequence of three, or array of shape (k, 3)
        Angular velocity along the principal axes at t = 0, rad/s; k starts at once.
    times : array of shape (n,)
        s from the start.
    accuracy : float, optional
        Relative error that must be kept.

    Returns
    -------
    Dataset
        Over `time` (s): `omega_body`, `angular_momentum_body`, `omega_inertial` (along
        `component`), `attitude` (unit quaternion along `quaternion`, body to inertial; the
        inertial axes are those of the body at t = 0), `energy`; and, for one start, Poinsot's
        ellipsoids, polhode and herpolhode.

    Raises
    ------
    EarthspinError
        For moments that no body has, a start without angular momentum, or numbers that are
        not finite.
    """
    rotor = {"moments": moments, "omega": omega, "times": times}
    return run(Scene(compute="free-rotor", tables={"rotor": rotor}, accuracy=accuracy))


def heavy_top(times: Any, *, accuracy: float | None = None, **top: Any) -> xr.Dataset:
    """Motion of a heavy symmetric top, by elliptic functions (I.7).

    Parameters
    ----------
    times : array of shape (n,)
        s from the start.
    accuracy : float, optional
        Relative error that must be kept.
    **top
        `transverse_moment` I1 about the pivot, `axial_moment` I3 (kg m2), `weight_moment` m g r
        (N m), `theta` (rad), `spin` omega3 (rad/s), and, if not zero, `phi_rate`,
        `theta_rate` (rad/s), `phi`, `psi` (rad). Text and Quantity carry units.

    Returns
    -------
    Dataset
        Over `time` (s): `theta`, `phi`, `psi` (rad), `attitude`, `omega_body`; `turning_angle`
        along `turning`, `pattern` (wave, cusp, loop, sleeping, steady), `nutation_period`,
        `mean_precession_rate`, and the effective potential along `inclination`.

    Raises
    ------
    EarthspinError
        For a top that cannot be, or a start out of range.
    """
    return run(Scene(compute="top", tables={"top": {**top, "times": times}}, accuracy=accuracy))


def spheroid_field(
    position: Any,
    *,
    body: Body | str = "earth",
    point_mass: Any = 1.0,
    accuracy: float | None = None,
) -> xr.Dataset:
    """Exact field of a homogeneous spheroid with the mass and figure of a body (I.9).

    Parameters
    ----------
    position : array of shape (n, 3)
        From the centre, z along the axis, m.
    body : Body or str
        Its `gm`, `radius` and `flattening` are used; the flattening may be negative (prolate)
        or zero (sphere).
    point_mass : float
        Mass at each point, kg, whose torque on the body is given.
    accuracy : float, optional
        Relative error that must be kept.

    Returns
    -------
    Dataset
        Along `point`: `potential`, `attraction`, `torque`.

    Raises
    ------
    EarthspinError
        For a body without a figure, or positions that are not finite.
    """
    table = {"position": position, "point_mass": point_mass}
    return run(Scene(compute="spheroid", body=body, tables={"spheroid": table}, accuracy=accuracy))


def polar_motion(
    *,
    file: str | Path = "c04",
    kind: str | None = None,
    span: tuple[Any, Any] | None = None,
    method: str = "burg",
) -> xr.Dataset:
    """Observed polar motion, and the free wobble in it.

    Parameters
    ----------
    file : str or Path
        ``"c04"``, the daily table of the IERS that astropy carries, or a local file.
    kind : str, optional
        ``"c04"``, ``"c01"`` or ``"finals2000A"``; told from the file by default.
    span : pair of dates, optional
    method : str
        As of `fit_chandler`.

    Returns
    -------
    Dataset
        Over `time`: `x`, `y` (arcsec) with their 95 % half-widths. Over `middle`, the
        middles of sliding windows, what `fit_chandler` gives.

    Raises
    ------
    EarthspinError
        Whatever is wrong with the file or the span, in one line.
    """
    settings = {"file": str(file), "kind": kind, "method": method}
    return run(Scene(compute="polar-motion", span=span, tables={"polar_motion": settings}))


def fit_chandler(
    ds: xr.Dataset, *, method: str = "burg", window: float | None = None
) -> xr.Dataset:
    """Period, quality factor and amplitude of the free wobble in polar motion.

    Parameters
    ----------
    ds : Dataset
        `x` and `y` over `time`, evenly spaced, with units ("arcsec" or "mas").
    method : str
        ``"burg"``, ``"likelihood"``, or ``"least-squares"``, which gives no quality factor.
    window : float, optional
        Length of the sliding windows, d; one beat of annual and free wobble by default.

    Returns
    -------
    Dataset
        `chandler_period` (d) and `chandler_quality_factor`, `..._low`, `..._high` with 95 %
        intervals; over `time`, the middles of the windows, `chandler_amplitude` (mas) and
        its phase, the annual amplitudes and the mean pole.

    Raises
    ------
    EarthspinError
        If the series is uneven, has no numbers, or is too short; it says how long is needed.
    """
    from earthspin.scene.parts.observed_pole import chandler_in

    return chandler_in(ds, method, window).rename(middle="time")


def excitation(
    ds: xr.Dataset, *, period: float = 433.0, quality_factor: float = 100.0
) -> xr.Dataset:
    """Excitation that polar motion asks for: exact means over each step.

    Parameters
    ----------
    ds : Dataset
        `x` and `y` over `time`, evenly spaced.
    period : float
        Of the free wobble, d.
    quality_factor : float

    Returns
    -------
    Dataset
        `chi1`, `chi2` (mas) over `time`, the middles of the steps.
    """
    from earthspin.scene.parts.observed_pole import excitation_of

    return excitation_of(ds, period, quality_factor)


def polar_motion_from(
    chi: xr.Dataset,
    *,
    period: float | None = None,
    quality_factor: float | None = None,
    start: tuple[float, float] | None = None,
) -> xr.Dataset:
    """Polar motion that an excitation drives: the inverse of `excitation`.

    Parameters
    ----------
    chi : Dataset
        `chi1`, `chi2` (mas) over `time`, means over even steps.
    period, quality_factor : float, optional
        Of the free wobble; those that `excitation` noted by default.
    start : pair of float, optional
        x and y at the start, mas; as noted, or zero.

    Returns
    -------
    Dataset
        `x`, `y` (arcsec) over `time`, the ends of the steps.
    """
    from earthspin.scene.parts.observed_pole import pole_from

    return pole_from(chi, period, quality_factor, start)


def read_excitation(path: str | Path) -> xr.Dataset:
    """Read effective angular momentum functions in the common ASCII layout.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Dataset
        `chi1`, `chi2` (mas) over `time`: mass and motion terms together.
    """
    from earthspin.scene.parts.observed_pole import excitation_from_file

    return excitation_from_file(path)
