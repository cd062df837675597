"""Signatures of the public names, written by `python -m data_tools signatures`."""

import datetime as dt
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal

import numpy as np
import pandas as pd
import xarray as xr
from astropy.time import Time
from astropy.units import Quantity
from numpy.typing import ArrayLike
from skyfield.jpllib import SpiceKernel
from skyfield.timelib import Time as SkyfieldTime
from skyfield.vectorlib import VectorFunction

from earthspin.interior.layers import LayeredBody
from earthspin.sky.orbit_table import OrbitTable

Value = str | float | Quantity | dt.timedelta | np.timedelta64
Pure = float | Quantity
Values = ArrayLike | Quantity | xr.DataArray | Sequence[Value] | Sequence[Sequence[Value]]
Date = str | dt.date | np.datetime64 | Time | SkyfieldTime
Dates = Time | SkyfieldTime | ArrayLike | xr.DataArray | Sequence[Date]
Epoch = str | Quantity | Date
Epochs = Quantity | Dates | Sequence[Epoch]

from earthspin.bodies import BODIES as BODIES
from earthspin.bodies import EARTH as EARTH
from earthspin.bodies import MARS as MARS
from earthspin.bodies import MOON as MOON
from earthspin.bodies import SUN as SUN
from earthspin.bodies import Body as Body
from earthspin.bodies import Orbit as Orbit
from earthspin.sky.orbit_files import read_orbit as read_orbit
from earthspin.questions.insolation import daily_insolation as daily_insolation
from earthspin.stars_near_pole import pole_stars as pole_stars
from earthspin.solutions import read_solution as read_solution
from earthspin.questions.polar_motion import excitation as excitation
from earthspin.questions.polar_motion import fit_chandler as fit_chandler
from earthspin.questions.polar_motion import polar_motion_from as polar_motion_from
from earthspin.questions.polar_motion import read_excitation as read_excitation
from earthspin.errors import EarthspinError as EarthspinError
from earthspin.errors import ArgumentError as ArgumentError
from earthspin.errors import SceneError as SceneError
from earthspin.errors import BodyError as BodyError
from earthspin.errors import UnitsError as UnitsError
from earthspin.errors import KernelError as KernelError
from earthspin.errors import CoverageError as CoverageError
from earthspin.errors import UndefinedError as UndefinedError
from earthspin.errors import ApartError as ApartError
from earthspin.errors import SeriesError as SeriesError
from earthspin.errors import AccuracyError as AccuracyError
from earthspin.errors import OutputError as OutputError
from earthspin.errors import MissingExtraError as MissingExtraError
from earthspin.scenes import Scene as Scene
from earthspin.scenes import VersionWarning as VersionWarning
from earthspin.scenes import ensemble as ensemble
from earthspin.scenes import load_scene as load_scene
from earthspin.scenes import plan as plan
from earthspin.scenes import run as run
from earthspin.scenes import run_tree as run_tree
from earthspin.scenes import write_series as write_series
from earthspin.engine.store import open as open
from earthspin.engine.store import read as read
from earthspin.engine.store import verify as verify
from earthspin.engine.store import write as write
from earthspin._version import __version__ as __version__

def precession(
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    span: tuple[Date, Date] | SkyfieldTime | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def torque_series(
    start: Date | None = ...,
    stop: Date | None = ...,
    step: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    times: Dates | None = ...,
    equator: Literal["mean", "true"] | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def pole(
    start: Date | None = ...,
    stop: Date | None = ...,
    step: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    times: Dates | None = ...,
    effects: Literal["known", "rigid", "all"]
    | Literal[
        "planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order", "nonrigid"
    ]
    | Sequence[
        Literal[
            "planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order", "nonrigid"
        ]
    ]
    | None = ...,
    response: Literal["fitted", "predicted"] | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def compare_iau(
    start: Date | None = ...,
    stop: Date | None = ...,
    step: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    times: Dates | None = ...,
    effects: Literal["known", "rigid", "all"]
    | Literal[
        "planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order", "nonrigid"
    ]
    | Sequence[
        Literal[
            "planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order", "nonrigid"
        ]
    ]
    | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def nutation_ladder(
    start: Date | None = ...,
    stop: Date | None = ...,
    step: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    times: Dates | None = ...,
    effects: Literal["known", "rigid", "all"]
    | Literal[
        "planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order", "nonrigid"
    ]
    | Sequence[
        Literal[
            "planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order", "nonrigid"
        ]
    ]
    | None = ...,
    coupling: Literal["none", "inferred"] | None = ...,
    anelastic_exponent: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def long_term(
    start: Date | None = ...,
    stop: Date | None = ...,
    step: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    times: Epochs | None = ...,
    orbit: str | PathLike[str] | OrbitTable | None = ...,
    tides: Value | None = ...,
    ellipticity: Value | None = ...,
    j2_rate: Value | None = ...,
    obliquity_shift: Value | None = ...,
    longitude_shift: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def insolation(
    start: Date | None = ...,
    stop: Date | None = ...,
    step: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    times: Epochs | None = ...,
    orbit: str | PathLike[str] | OrbitTable | None = ...,
    tides: Value | None = ...,
    ellipticity: Value | None = ...,
    j2_rate: Value | None = ...,
    obliquity_shift: Value | None = ...,
    longitude_shift: Value | None = ...,
    mean: Literal[
        "day",
        "interval",
        "window",
        "year",
        "caloric",
        "above",
        "extremes",
        "all-extremes",
        "seasons",
    ]
    | None = ...,
    latitude: Values | None = ...,
    longitude: Values | None = ...,
    mean_longitude: Values | None = ...,
    day: Values | None = ...,
    window: Value | None = ...,
    threshold: Value | None = ...,
    solar_constant: Value | None = ...,
    solar_constant_error: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def rotation(
    start: Date | None = ...,
    stop: Date | None = ...,
    step: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    times: Dates | None = ...,
    effects: Literal["known", "rigid", "all"]
    | Literal[
        "planets",
        "j3",
        "j4",
        "triaxiality",
        "geodesic",
        "j2-rate",
        "second-order",
        "nonrigid",
        "harmonics",
        "tides",
        "fluid-core",
        "flattened-perturber",
    ]
    | Sequence[
        Literal[
            "planets",
            "j3",
            "j4",
            "triaxiality",
            "geodesic",
            "j2-rate",
            "second-order",
            "nonrigid",
            "harmonics",
            "tides",
            "fluid-core",
            "flattened-perturber",
        ]
    ]
    | None = ...,
    start_attitude: Values | None = ...,
    start_omega: Values | None = ...,
    torque: Callable[[np.ndarray, np.ndarray, np.ndarray], ArrayLike] | None = ...,
    tolerance: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def wobble_ladder(
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    ocean: Literal["real", "global", "none"] | None = ...,
    anelastic_exponent: Value | None = ...,
    k2: Value | None = ...,
    core_fraction: Value | None = ...,
    core_ellipticity: Value | None = ...,
    ocean_love_number: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def polar_motion(
    start: Date | None = ...,
    stop: Date | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    span: tuple[Date, Date] | SkyfieldTime | None = ...,
    file: str | PathLike[str] | xr.Dataset | pd.DataFrame | None = ...,
    kind: Literal["c04", "c01", "finals2000A"] | None = ...,
    columns: str | None = ...,
    method: Literal["burg", "likelihood"] | None = ...,
    window: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def pole_offsets(
    start: Date | None = ...,
    stop: Date | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    span: tuple[Date, Date] | SkyfieldTime | None = ...,
    file: str | PathLike[str] | xr.Dataset | pd.DataFrame | None = ...,
    kind: Literal["c04", "c01", "finals2000A"] | None = ...,
    columns: str | None = ...,
    window: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def length_of_day(
    start: Date | None = ...,
    stop: Date | None = ...,
    step: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    perturbers: Body
    | str
    | Mapping[str, Any]
    | VectorFunction
    | Sequence[Body | str | Mapping[str, Any] | VectorFunction]
    | None = ...,
    ephemeris: str | PathLike[str] | SpiceKernel | None = ...,
    source: Literal["jplephem", "skyfield"] | None = ...,
    times: Dates | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def observed_day(
    start: Date | None = ...,
    stop: Date | None = ...,
    *,
    span: tuple[Date, Date] | SkyfieldTime | None = ...,
    file: str | PathLike[str] | None = ...,
    columns: str | None = ...,
    tides: Literal["left in", "taken out"] | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def forecast(
    days: Value | None = ...,
    step: Value | None = ...,
    origin: Date | float | None = ...,
    file: str | PathLike[str] | xr.Dataset | pd.DataFrame | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    start: Date | float | None = ...,
    columns: str | None = ...,
    parameters: Literal["shipped", "fitted"] | None = ...,
    bulletin_a: bool | None = ...,
    excitation: xr.Dataset | pd.DataFrame | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def free_rotor(
    moments: Values | Mapping[str, Value],
    omega: Values,
    times: Values | None = ...,
    *,
    duration: Value | None = ...,
    points: int | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def heavy_top(
    times: Values | None = ...,
    *,
    duration: Value | None = ...,
    points: int | None = ...,
    transverse_moment: Value,
    axial_moment: Value,
    weight_moment: Value,
    theta: Value,
    spin: Value,
    phi_rate: Value | None = ...,
    theta_rate: Value | None = ...,
    phi: Value | None = ...,
    psi: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def spheroid_field(
    position: Values,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    point_mass: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def cassini_states(
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    orbit: Orbit | Mapping[str, Any] | None = ...,
    *,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...
def love_numbers(
    interior: str | LayeredBody | Mapping[str, Any] | None = ...,
    period: Value | None = ...,
    *,
    body: Body | str | Mapping[str, Any] | VectorFunction | None = ...,
    anelastic_exponent: Value | None = ...,
    members: int | Mapping[str, Any] | xr.Dataset | str | None = ...,
) -> xr.Dataset: ...

__all__ = [
    "__version__",
    "AccuracyError",
    "ApartError",
    "ArgumentError",
    "BODIES",
    "Body",
    "BodyError",
    "CoverageError",
    "EARTH",
    "EarthspinError",
    "KernelError",
    "MARS",
    "MOON",
    "MissingExtraError",
    "Orbit",
    "OutputError",
    "SUN",
    "Scene",
    "SceneError",
    "SeriesError",
    "UndefinedError",
    "UnitsError",
    "VersionWarning",
    "cassini_states",
    "compare_iau",
    "daily_insolation",
    "ensemble",
    "excitation",
    "fit_chandler",
    "forecast",
    "free_rotor",
    "heavy_top",
    "insolation",
    "length_of_day",
    "load_scene",
    "long_term",
    "love_numbers",
    "nutation_ladder",
    "observed_day",
    "plan",
    "polar_motion",
    "polar_motion_from",
    "pole",
    "pole_offsets",
    "pole_stars",
    "precession",
    "read",
    "read_excitation",
    "read_orbit",
    "read_solution",
    "rotation",
    "run",
    "run_tree",
    "spheroid_field",
    "torque_series",
    "verify",
    "wobble_ladder",
    "write",
    "write_series",
]
