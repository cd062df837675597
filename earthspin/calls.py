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
        Relative error of the rate that must be met.

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


def wobble_ladder(*, body: Body | str = "earth") -> xr.Dataset:
    """Period of the free wobble of a rigid body, rung by rung (I.6).

    Parameters
    ----------
    body : Body or str

    Returns
    -------
    Dataset
        Along `rung`: `period_solar` (d of 86400 s), `period_sidereal` and `factor`.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.
    """
    return run(Scene(compute="wobble", body=body))
