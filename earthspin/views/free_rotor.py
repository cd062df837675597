"""Figures and three-dimensional pictures of a rotor without torque."""

from __future__ import annotations

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.quaternion import multiply, rotate
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.views import drawing, solids
from earthspin.views.drawing import BLUE, GREEN, RED, Axes, PageFigure, axes
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.solids import BLACK, GREY, Solid

# --- figures -------------------------------------------------------------------------------------


def _caption_of_herpolhode(tree: Result) -> str:
    poinsot = needed(tree, "poinsot")
    returns = "The curve does not come back to its start."
    if "herpolhode_advance" in poinsot:
        turned = float(np.degrees(poinsot.herpolhode_advance))
        period = float(poinsot.polhode_period)
        returns = f"In one period of the polhode, {period:.4g} s, it advances by {turned:.4f} deg."
    return (
        "Path of the tip of the angular velocity in the invariable plane, between its two bounding "
        f"circles (dashed). {returns}"
    )


def plot_components(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the components of angular velocity along the principal axes over time.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``free-rotor``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    ax = axes(ax, 8, 3.4)
    answer = answer_of(result)
    drawing.lines(ax, answer.time, answer.omega_body, lw=1.2)
    ax.set(xlabel="time (s)", ylabel="angular velocity (rad/s)")
    drawing.legend_above(ax)
    return ax


def plot_herpolhode(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the path of the angular velocity in the invariable plane (herpolhode) and its bounds.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``free-rotor``; without the section ``poinsot`` it is run again.
    ax : Axes, optional
    """
    poinsot = needed(result, "poinsot")
    ax = axes(ax, 5, 5)
    turn = np.linspace(0, 2 * np.pi, 181)
    for radius in poinsot.herpolhode_radius.values:
        ax.plot(radius * np.cos(turn), radius * np.sin(turn), color="0.5", lw=0.8, ls="--")
    x, y = poinsot.herpolhode.transpose("in_plane", ...).values
    ax.plot(x, y, color=RED, lw=1.0)
    words = "in the invariable plane (rad/s)"
    ax.set(aspect="equal", xlabel=words, ylabel=words)
    return ax


FIGURES = [
    PageFigure(
        "Angular velocity in the body",
        "Components of the angular velocity along the principal axes.",
        plot_components,
    ),
    PageFigure(
        "Herpolhode", _caption_of_herpolhode, plot_herpolhode, section="poinsot", square=True
    ),
]


# --- solids --------------------------------------------------------------------------------------


def ellipsoids_with_polhodes(tree: Result) -> Solid:
    """Three-dimensional picture of the inertia and momentum ellipsoids, with the polhode.

    The ellipsoids meet in the polhode (source text, I.5.1 to I.5.5).
    """
    answer, poinsot = answer_of(tree), needed(tree, "poinsot")
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
    """Three-dimensional picture of the inertia ellipsoid, polhode, and a sphere of mean spin.

    See the source text, I.5.4.
    """
    answer, poinsot = answer_of(tree), needed(tree, "poinsot")
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
    answer, poinsot = answer_of(tree), needed(tree, "poinsot")
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
    inside = float(rotor.theta) < float(rotor.alpha)
    roll = "with its inner side on" if inside else "on the outside of"
    between = (
        "The body is oblate: the angular momentum lies between the axis and the angular velocity."
        if inside
        else "The body is prolate: the angular velocity lies between the angular momentum and the "
        "axis."
    )
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
        radius=float(1.3 * speed),
        times=times,
        attitude=rotor.attitude(times),
    )


def _turn_to_z(vector: FloatArray) -> FloatArray:
    """Quaternion of the smallest rotation that makes a vector parallel to the third axis."""
    unit = vector / np.linalg.norm(vector)
    half = np.array([1 + unit[2], unit[1], -unit[0], 0.0])
    return np.asarray(half / np.linalg.norm(half))


SOLIDS = [
    ("poinsot", make) for make in (ellipsoids_with_polhodes, polhode_with_sphere, rolling_ellipsoid)
]
