"""Figures and three-dimensional pictures of free rotors, heavy tops and rotation under torques."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.constants import DAY
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.quaternion import multiply, rotate
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.views import drawing, solids
from earthspin.views.drawing import BLUE, GREEN, RED, Axes, Figure, Views, axes, page_figure
from earthspin.views.result_contents import Result, answer_of, section
from earthspin.views.solids import BLACK, GREY, Solid

#: Times at which curves in closed form are drawn: the steps of some dozen turns are then small.
POINTS = 4001
#: Change of the inclination below which a top neither nutates nor falls, deg.
STILL = 1e-6
#: Spread of the components of a spin, relative to its size, below which their changes are drawn.
STEADY = 0.02


@page_figure(
    "Angular velocity in the body",
    "Components of the angular velocity along the principal axes.",
    points=POINTS,
)
def plot_components(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the components of angular velocity along the principal axes over time.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``free-rotor``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    ax = axes(ax, 8, 3.4)
    answer = answer_of(result)
    drawing.lines(ax, answer.time, answer.omega_body, lw=1.2)
    ax.set(xlabel="time (s)", ylabel="angular velocity (rad/s)")
    drawing.legend_above(ax)
    return ax


@page_figure(
    "Herpolhode",
    "Path of the tip of the angular velocity in the invariable plane, between its two bounding "
    "circles (dashed). The table gives the angle by which it advances in a period of the polhode, "
    "if the motion is periodic.",
    section="poinsot",
    square=True,
    points=POINTS,
)
def plot_herpolhode(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the path of the angular velocity in the invariable plane (herpolhode) and its bounds.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``free-rotor``; computed again if the section ``poinsot`` is missing.
    ax : Axes, optional
    """
    poinsot = section(result, "poinsot")
    ax = axes(ax, 5, 5)
    turn = np.linspace(0, 2 * np.pi, 181)
    for radius in poinsot.herpolhode_radius.values:
        ax.plot(radius * np.cos(turn), radius * np.sin(turn), color="0.5", lw=0.8, ls="--")
    x, y = poinsot.herpolhode.transpose("in_plane", ...).values
    ax.plot(x, y, color=RED, lw=1.0)
    words = "in the invariable plane (rad/s)"
    ax.set(aspect="equal", xlabel=words, ylabel=words)
    return ax


def ellipsoids_with_polhodes(tree: Result) -> Solid:
    """Three-dimensional picture of the inertia and momentum ellipsoids, with the polhode.

    The ellipsoids meet in the polhode (source text, I.5.1 to I.5.5).
    """
    answer, poinsot = answer_of(tree), section(tree, "poinsot")
    inertia, momentum = poinsot.inertia_ellipsoid.values, poinsot.momentum_ellipsoid.values
    polhode = poinsot.polhode.values
    return Solid(
        title="Two ellipsoids and a polhode",
        caption="Seen in the body, the angular velocity stays on the inertia ellipsoid (blue, "
        "constant energy) and on the momentum ellipsoid (red, constant angular momentum). So it "
        "moves along their intersection, the polhode (heavy line). The thinner curve is the "
        "polhode of the opposite start.",
        items=[
            solids.mesh(solids.ellipsoid(inertia), BLUE),
            solids.mesh(solids.ellipsoid(momentum), RED, opacity=0.12),
            solids.line(polhode, BLACK, width=3),
            solids.line(-polhode, GREY, width=2),
            solids.moving_arrow(answer.omega_body.values, GREEN, "ω"),
        ],
        radius=float(1.15 * max(inertia.max(), momentum.max())),
        times=answer.time.values,
    )


def polhode_with_sphere(tree: Result) -> Solid:
    """Three-dimensional picture of inertia ellipsoid and polhode, with a sphere for the mean speed.

    See the source text, I.5.4.
    """
    answer, poinsot = answer_of(tree), section(tree, "poinsot")
    inertia, polhode = poinsot.inertia_ellipsoid.values, poinsot.polhode.values
    speed = np.linalg.norm(polhode, axis=1)
    mean = float(speed.mean())
    return Solid(
        title="A polhode is not on a sphere",
        caption="The inertia ellipsoid (blue), a polhode (heavy line) and a sphere whose radius is "
        "the mean angular speed on that polhode (green). The curve lies outside the sphere where "
        f"the body rotates faster than the mean and inside where it rotates slower: the speed "
        f"varies from {speed.min():.4g} to {speed.max():.4g} rad/s. No sphere contains the curve, "
        "so the angular speed of a free body is not constant in general.",
        items=[
            solids.mesh(solids.ellipsoid(inertia), BLUE, opacity=0.1),
            solids.mesh(solids.ellipsoid((mean, mean, mean)), GREEN, opacity=0.25),
            solids.line(polhode, BLACK, width=3),
            solids.moving_arrow(answer.omega_body.values, RED, "ω"),
        ],
        radius=float(1.15 * max(inertia.max(), mean)),
        times=answer.time.values,
    )


def rolling_ellipsoid(tree: Result) -> Solid:
    """Three-dimensional picture of the inertia ellipsoid rolling on the invariable plane.

    See Poinsot's construction in the source text, I.5.8 and I.5.9.
    """
    answer, poinsot = answer_of(tree), section(tree, "poinsot")
    to_plane = _turn_to_z(answer.angular_momentum_body.values[0])
    attitude = np.array([multiply(to_plane, q) for q in answer.attitude.values])
    omega = rotate(attitude, answer.omega_body.values)
    height = float(poinsot.invariable_plane_distance)
    semi_axes = poinsot.inertia_ellipsoid.values
    outer = float(poinsot.herpolhode_radius.sel(bound="outer"))
    half = 1.15 * max(outer, float(semi_axes.max()))
    return Solid(
        title="The ellipsoid rolls on the invariable plane",
        caption="Seen in space, with the angular momentum vertical, the inertia ellipsoid touches "
        "a fixed plane at the tip of the angular velocity and rolls on it without slipping. The "
        "point of contact draws the polhode on the ellipsoid (heavy line) and the herpolhode on "
        "the plane (red).",
        items=[
            solids.mesh(solids.ellipsoid(semi_axes), BLUE, frame="body", opacity=0.13),
            solids.line(poinsot.polhode.values, BLACK, width=2.5, frame="body"),
            solids.mesh(solids.square(half, height), GREY, opacity=0.1),
            solids.line(omega, RED, width=2, grows=True),
            solids.moving_arrow(omega, GREEN, "ω"),
            solids.arrow(np.array([0, 0, 1.25 * height]), BLACK, "L"),
        ],
        radius=float(1.6 * max(half, height)),
        times=answer.time.values,
        attitude=attitude,
        tilt=0.2,
    )


def rolling_cones(rotor: SymmetricRotor, title: str, points: int = 241) -> Solid:
    """Three-dimensional picture of the body cone rolling on the space cone.

    See the source text, I.6.30 and I.6.31.
    """
    period = 2 * np.pi / float(rotor.precession_rate)
    times = np.linspace(0, 2 * period, points)
    omega = rotor.omega_inertial(times)
    speed = float(np.linalg.norm(omega[0]))
    axis = rotor.figure_axis(times)
    momentum, velocity = "the angular momentum", "the angular velocity"
    shape, roll, middle, other = "prolate", "on the outside of", velocity, momentum
    if float(rotor.theta) < float(rotor.alpha):
        shape, roll, middle, other = "oblate", "with its inner side on", momentum, velocity
    between = f"The body is {shape}: {middle} lies between {other} and the axis."
    return Solid(
        title=title,
        caption="The body cone (red) is fixed in the body, about its axis; the space cone (blue) "
        f"is fixed in space, about the angular momentum. The body cone rolls {roll} the space cone "
        f"without slipping, and they touch along the angular velocity (green). {between}",
        items=[
            solids.mesh(solids.cone(abs(float(rotor.space_cone)), speed), BLUE, opacity=0.2),
            solids.mesh(solids.cone(float(rotor.alpha), speed), RED, frame="body", opacity=0.2),
            solids.moving_arrow(omega, GREEN, "ω"),
            solids.moving_arrow(1.15 * speed * axis, RED, "axis"),
            solids.arrow(np.array([0.0, 0.0, 1.2 * speed]), BLACK, "L"),
        ],
        radius=float(0.75 * speed),
        height=float(0.6 * speed),
        times=times,
        attitude=rotor.attitude(times),
    )


def _turn_to_z(vector: FloatArray) -> FloatArray:
    """Quaternion of the smallest rotation that turns a given vector to the third axis."""
    unit = vector / np.linalg.norm(vector)
    half = np.array([1 + unit[2], unit[1], -unit[0], 0.0])
    return np.asarray(half / np.linalg.norm(half))


ROTOR_SOLIDS = [
    ("poinsot", make) for make in (ellipsoids_with_polhodes, polhode_with_sphere, rolling_ellipsoid)
]


# --- heavy tops ----------------------------------------------------------------------------------


@page_figure(
    "Effective potential and nutation",
    "Left: the effective potential as a function of the inclination, and the energy of the top "
    "(dashed); the inclination varies where the energy lies above the potential. Right: the "
    "inclination in time or, if it does not change, the horizontal components of a line across "
    "the axis that turns with the top.",
    section="potential",
    uses=["turning"],
    points=POINTS,
)
def _plot_potential_and_nutation(tree: Result, figure: Figure | None = None) -> Figure:
    answer, figure = answer_of(tree), figure or drawing.empty(8, 3.4)
    left, right = figure.subplots(1, 2)
    plot_effective_potential(tree, ax=left)
    inclination = np.degrees(answer.theta.values)
    if np.ptp(inclination) > STILL:
        right.plot(answer.time, inclination, color=BLUE, lw=1.2)
        right.set(xlabel="time (s)", ylabel="inclination (deg)")
    else:
        line = rotate(answer.attitude.values, np.array([1.0, 0.0, 0.0]))
        for name, values, colour in zip("xy", line.T, (BLUE, RED), strict=False):
            right.plot(answer.time, values, color=colour, lw=1.2, label=name)
        right.set(xlabel="time (s)", ylabel="direction of a line in the body (1)")
        drawing.legend_above(right)
    return figure


def plot_effective_potential(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the effective potential of a top over the inclination of the axis, and the top's energy.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``top``; computed again if its section ``potential`` or ``turning``
        is missing.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    potential = section(result, "potential").effective_potential
    ax = axes(ax, 4, 3.4)
    turning = np.degrees(section(result, "turning").turning_angle.values)
    level = float(np.interp(turning, potential.inclination, potential).max())
    lowest = float(potential.min())
    reach = max(level - lowest, 0.05 * abs(lowest), 1e-9)
    ax.plot(potential.inclination, potential, color=BLUE, lw=1.2)
    ax.axhline(level, color="0.4", lw=0.9, ls="--")
    ax.set_ylim(lowest - 0.2 * reach, level + 2 * reach)
    ax.set(xlabel="inclination (deg)", ylabel="effective potential (rad²/s²)")
    return ax


def path_of_top(tree: Result) -> solids.Solid:
    """Three-dimensional picture of the path of the top's axis on a sphere.

    The path lies between two turning angles (source text, I.7.19).
    """
    answer = answer_of(tree)
    theta, phi = answer.theta.values, answer.phi.values
    across, height = np.sin(theta), np.cos(theta)
    tip = np.stack([across * np.sin(phi), -across * np.cos(phi), height], axis=-1)
    bounds = section(tree, "turning").turning_angle.values
    return solids.Solid(
        title=f"{answer.attrs['title']}: {answer.pattern.item()}",
        caption="The tip of the axis (red) moves between two circles (grey), the turning angles.",
        items=[
            solids.mesh(solids.ellipsoid((1.0, 1.0, 1.0), 19, 37), BLUE, opacity=0.06),
            *(solids.line(solids.circle(float(b)), solids.GREY, width=1.2) for b in bounds),
            solids.line(tip, RED, width=2.5, grows=True),
            solids.moving_arrow(tip, solids.BLACK, "axis"),
        ],
        radius=1.15,
        times=answer.time.values,
        attitude=answer.attitude.values,
    )


# --- rotation under torques ----------------------------------------------------------------------


#: An attitude is lost where its error is a quarter of a turn, deg.
LOST = 90.0
#: Poses that a picture which plays shows at most.
POSES = 481


def _days(answer: xr.Dataset) -> FloatArray:
    time = answer.time.values
    return np.asarray((time - time[0]) / np.timedelta64(1, "D"))


def _label(ax: Axes, words: str) -> Axes:
    ax.set(xlabel="time from the start (d)", ylabel=words)
    drawing.legend_above(ax)
    return ax


@page_figure(
    "Spin in the body",
    "Components of the angular velocity along the principal axes, C last; of a steady spin "
    "their differences from the mean.",
)
def plot_spin(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the components of angular velocity along the principal axes over time.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``rotation``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    ax = axes(ax, 8, 3.4)
    answer = answer_of(result)
    spin, mean = np.degrees(answer.omega) * DAY, np.degrees(answer.omega.mean("time")) * DAY
    size = float(np.sqrt((mean**2).sum()))
    if float(abs(spin - mean).max()) < STEADY * size:
        drawing.lines(ax, _days(answer), 1e6 * (spin - mean) / size, lw=1.1)
        return _label(ax, "angular velocity minus its\nmean (1e-6 of its length)")
    drawing.lines(ax, _days(answer), spin, lw=1.1)
    return _label(ax, "angular velocity (deg/d)")


@page_figure(
    "How well the attitude is known",
    "Error of the attitude over time: from the integration (the difference of two solutions), "
    "and from the uncertainties of the inputs and of the positions.",
)
def plot_attitude_error(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the error of the attitude over time, for each cause (method, inputs, kernel).

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``rotation``.
    ax : Axes, optional
    """
    ax = axes(ax, 8, 3.4)
    answer = answer_of(result)
    shares = [str(name) for name in answer if str(name).startswith("attitude_error_")]
    for colour, name in zip(drawing.CYCLE, shares, strict=False):
        error, cause = answer[name].values, name.split("_")[-1]
        shown = np.isfinite(error) & (error > 0)
        if shown.any():
            ax.semilogy(_days(answer)[shown], error[shown], color=colour, lw=1.2, label=cause)
    ax.axhline(LOST, color="0.4", lw=0.8, ls="--")
    return _label(ax, "error of the attitude (deg)")


@page_figure(
    "Divergence of neighbouring rotations",
    "Logarithm of the distance of neighbouring rotations; a straight line means chaos.",
    section="divergence",
)
def plot_growth(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the divergence of two rotations from nearly equal starts, as a logarithm over time.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``rotation``; computed again if the section
        ``divergence`` is missing.
    ax : Axes, optional
    """
    ax = axes(ax, 8, 3.4)
    neighbour = section(result, "divergence")
    days = _days(neighbour)
    ax.plot(days, neighbour.growth, color=RED, lw=1.2, label="neighbour")
    if "lyapunov_time" in neighbour:
        time, error = float(neighbour.lyapunov_time), float(neighbour.lyapunov_time_error)
        words = f"e-fold in {time:.3g} ± {error:.2g} d"
        ax.plot(days, days / time, "k--", lw=0.9, label=words)
    return _label(ax, "logarithm of the distance (1)")


#: Semi-axes of what is drawn: the shape of no body in particular.
SHAPE = (1.0, 0.8, 0.6)


def turning_body(tree: Result) -> Solid:
    """Animated three-dimensional picture of the rotation of a body, drawn as an ellipsoid."""
    poses = answer_of(tree).isel(time=slice(0, POSES))
    attitude, momentum = poses.attitude.values, poses.angular_momentum.values
    omega = rotate(attitude, poses.omega.values)
    return Solid(
        title="The body turns",
        caption="An ellipsoid fixed to the principal axes, its longest axis that of least "
        "moment (A, red) and its shortest that of most (C, black); the angular velocity "
        "(green) and the angular momentum (blue) in space, each over its largest length.",
        items=[
            solids.mesh(solids.ellipsoid(SHAPE), BLUE, frame="body", opacity=0.2),
            solids.arrow(np.array([1.25, 0.0, 0.0]), RED, "A", frame="body"),
            solids.arrow(np.array([0.0, 0.0, 1.0]), BLACK, "C", frame="body"),
            solids.moving_arrow(1.3 * omega / _largest(poses.omega.values), GREEN, "ω"),
            solids.moving_arrow(1.3 * momentum / _largest(momentum), BLUE, "L"),
        ],
        radius=1.5,
        times=_days(poses),
        unit="d",
        attitude=attitude,
    )


def _largest(vectors: FloatArray) -> float:
    """Length of the longest of several vectors; 1 if all vectors are zero."""
    return float(np.max(np.linalg.norm(vectors, axis=1))) or 1.0


VIEWS = {
    "free-rotor": Views([plot_components, plot_herpolhode], ROTOR_SOLIDS),
    "top": Views([_plot_potential_and_nutation], [("turning", path_of_top)]),
    "rotation": Views([plot_spin, plot_attitude_error, plot_growth], [("", turning_body)]),
}
