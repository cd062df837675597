"""The free rotor and the top, as pictures that can be turned and played."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.rotor.quaternion import multiply, rotate
from earthspin.scene.running import run
from earthspin.views.solids import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    RED,
    Solid,
    arrow,
    cone,
    ellipsoid,
    line,
    mesh,
    moving_arrow,
    square,
)


def ellipsoids_with_polhodes(result: xr.Dataset) -> Solid:
    """Inertia ellipsoid and momentum ellipsoid, meeting in the polhode (I.5.1 to I.5.5)."""
    inertia, momentum = result.inertia_ellipsoid.values, result.momentum_ellipsoid.values
    polhode = result.polhode.values
    return Solid(
        title="Two ellipsoids and a polhode",
        caption="In the body: the angular velocity stays on the inertia ellipsoid (blue, constant "
        "energy) and on the momentum ellipsoid (red), so it runs along the curve in which they "
        "meet, and along its mirror image for the opposite start.",
        items=[
            mesh(ellipsoid(inertia), BLUE),
            mesh(ellipsoid(momentum), RED, opacity=0.12),
            line(polhode, BLACK, width=3),
            line(-polhode, GREY, width=2),
            moving_arrow(result.omega_body.values, GREEN, "ω"),
        ],
        radius=float(1.15 * max(inertia.max(), momentum.max())),
        times=result.time.values,
        attitude=[[1.0, 0.0, 0.0, 0.0]] * result.time.size,
    )


def rolling_ellipsoid(result: xr.Dataset) -> Solid:
    """Poinsot: the inertia ellipsoid rolls on the invariable plane (I.5.8, I.5.9)."""
    to_plane = _turn_to_z(result.angular_momentum_body.values[0])
    attitude = np.array([multiply(to_plane, q) for q in result.attitude.values])
    omega = rotate(attitude, result.omega_body.values)
    height = float(result.invariable_plane_distance)
    semi_axes = result.inertia_ellipsoid.values
    outer = float(result.herpolhode_radius.sel(bound="outer"))
    half = 1.15 * max(outer, float(semi_axes.max()))
    return Solid(
        title="The ellipsoid rolls on the invariable plane",
        caption="In space, with the angular momentum upright: the inertia ellipsoid touches a "
        "fixed plane at the tip of the angular velocity and rolls on it without slipping. It is "
        "marked along the polhode (black), the plane along the herpolhode (red).",
        items=[
            mesh(ellipsoid(semi_axes), BLUE, frame="body", opacity=0.13),
            line(result.polhode.values, BLACK, width=2.5, frame="body"),
            mesh(square(half, height), GREY, opacity=0.1),
            line(omega, RED, width=2, grows=True),
            moving_arrow(omega, GREEN, "ω"),
            arrow(np.array([0, 0, 1.25 * height]), BLACK, "L"),
        ],
        radius=float(1.6 * max(half, height)),
        times=result.time.values,
        attitude=attitude,
        tilt=0.2,
    )


def rolling_cones(rotor: SymmetricRotor, title: str, points: int = 241) -> Solid:
    """Body cone on space cone (I.6.30, I.6.31)."""
    period = 2 * np.pi / float(rotor.precession_rate)
    times = np.linspace(0, 2 * period, points)
    omega = rotor.omega_inertial(times)
    speed = float(np.linalg.norm(omega[0]))
    axis = rotor.figure_axis(times)
    inside = float(rotor.theta) < float(rotor.alpha)
    roll = "inside out around" if inside else "around the outside of"
    return Solid(
        title=title,
        caption="The body cone (red), fixed in the body about its axis, rolls "
        f"{roll} the space cone (blue) about the angular momentum. They touch along the angular "
        "velocity (green). "
        + (
            "Oblate: the angular momentum lies between the axis and the angular velocity."
            if inside
            else "Prolate: the angular velocity lies between the angular momentum and the axis."
        ),
        items=[
            mesh(cone(abs(float(rotor.space_cone)), speed), BLUE, opacity=0.2),
            mesh(cone(float(rotor.alpha), speed), RED, frame="body", opacity=0.2),
            moving_arrow(omega, GREEN, "ω"),
            moving_arrow(1.15 * speed * axis, RED, "axis"),
            arrow(np.array([0.0, 0.0, 1.2 * speed]), BLACK, "L"),
        ],
        radius=float(1.3 * speed),
        times=times,
        attitude=rotor.attitude(times),
    )


def path_of_top(result: xr.Dataset) -> Solid:
    """Tip of the top's axis on a sphere (I.7.19)."""
    theta, phi = result.theta.values, result.phi.values
    tip = np.stack(
        [np.sin(theta) * np.sin(phi), -np.sin(theta) * np.cos(phi), np.cos(theta)], axis=-1
    )
    pattern = str(result.pattern.values)
    return Solid(
        title=f"{result.attrs['title']}: {pattern}",
        caption="The tip of the axis (red) runs between two circles (grey), the turning points.",
        items=[
            mesh(ellipsoid((1.0, 1.0, 1.0), 19, 37), BLUE, opacity=0.06),
            *(
                line(_circle(float(angle)), GREY, width=1.2)
                for angle in result.turning_angle.values
            ),
            line(tip, RED, width=2.5, grows=True),
            moving_arrow(tip, BLACK, "axis"),
        ],
        radius=1.15,
        times=result.time.values,
        attitude=result.attitude.values,
    )


def _circle(angle: float) -> np.ndarray:
    turn = np.linspace(0, 2 * np.pi, 91)
    return np.stack(
        [
            np.sin(angle) * np.cos(turn),
            np.sin(angle) * np.sin(turn),
            np.full_like(turn, np.cos(angle)),
        ],
        axis=-1,
    )


def _turn_to_z(vector: np.ndarray) -> np.ndarray:
    """Quaternion of the shortest turn that brings a vector to the third axis."""
    unit = vector / np.linalg.norm(vector)
    half = np.array([1 + unit[2], unit[1], -unit[0], 0.0])
    return np.asarray(half / np.linalg.norm(half))


def of_free_rotor(result: xr.Dataset) -> list[Solid]:
    """The solids of one free rotor."""
    return [ellipsoids_with_polhodes(result), rolling_ellipsoid(result)]


def gallery() -> tuple[str, str, list[Solid]]:
    """Title, lead and solids of the page of rotors and tops that comes with the report."""
    poinsot = run("poinsot")
    solids = of_free_rotor(poinsot)
    prolate = SymmetricRotor(equatorial=1.0, difference=-0.6, speed=1.0, alpha=0.35)
    oblate = SymmetricRotor(equatorial=1.0, difference=0.8, speed=1.0, alpha=0.6)
    solids.append(rolling_cones(prolate, "Rolling cones, prolate"))
    solids.append(rolling_cones(oblate, "Rolling cones, oblate"))
    solids += [path_of_top(run(name)) for name in ("top-wave", "top-cusp", "top-loop")]
    lead = (
        "How bodies turn without torque (I.5, I.6), and how a heavy top moves (I.7). "
        "Every picture can be turned with the mouse and played in time."
    )
    return "Rotors and tops", lead, solids
