"""Limits and symmetries, over any top that Hypothesis can think of."""

from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from earthspin.top.azimuth import mean_precession_rate
from earthspin.top.closed_form import HeavyTopMotion, heavy_top_motion
from earthspin.top.height import nutation_of, nutation_period, turning_angles
from earthspin.top.start import HeavyTop

# Below 1e-100 rad/s a top counts as still.
RATES = st.floats(-8, 8).map(lambda rate: rate if abs(rate) > 1e-90 else 0.0)
WEIGHTS = st.floats(-20, 20).map(lambda weight: weight if abs(weight) > 1e-180 else 0.0)
TIMES = np.array([-3.0, -0.4, 0.0, 0.9, 5.0])


@st.composite
def tops(draw: Any, weights: st.SearchStrategy[float] = WEIGHTS) -> HeavyTop:
    """Tops with moments of 1e-2 to 1e2 and rates to 8 rad/s, on the poles too."""
    i1 = draw(st.floats(1e-2, 1e2))
    return HeavyTop(
        transverse_moment=i1,
        axial_moment=i1 * draw(st.floats(0.05, 2.0)),
        weight_moment=i1 * draw(weights),
        theta=draw(st.floats(0, np.pi) | st.sampled_from([0.0, np.pi / 2, np.pi])),
        spin=draw(RATES | st.just(0.0)),
        phi_rate=draw(RATES | st.just(0.0)),
        theta_rate=draw(RATES | st.just(0.0)),
        phi=draw(st.floats(-3, 3)),
        psi=draw(st.floats(-3, 3)),
    )


def rotations(motion: HeavyTopMotion) -> Rotation:
    return Rotation.from_quat(motion.attitude[:, [1, 2, 3, 0]])


@given(tops())
def test_the_start_is_given_back(top: HeavyTop) -> None:
    motion = heavy_top_motion(top, [0.0])
    start = Rotation.from_euler("ZXZ", [float(top.phi), float(top.theta), float(top.psi)])
    assert (rotations(motion)[0] * start.inv()).magnitude() < 2e-14
    one, two, three = motion.omega_body[0]
    across = top.phi_rate * np.sin(top.theta)
    size = np.abs(across) + np.abs(top.theta_rate) + np.abs(top.spin) + 1
    assert three == top.spin
    # on the poles theta' and phi' sin(theta) point along axes that phi and psi tell
    found = (one + 1j * two) * np.exp(1j * top.psi)
    assert np.abs(found - (top.theta_rate + 1j * across)) < 1e-7 * size


@given(tops(weights=st.just(0.0)))
def test_without_weight_it_is_the_free_rotor(top: HeavyTop) -> None:
    """Turn about L at L/I1, and about the axis at omega3 (I1 - I3)/I1."""
    i1, i3 = float(top.transverse_moment), float(top.axial_moment)
    motion = heavy_top_motion(top, TIMES)
    start = heavy_top_motion(top, [0.0])
    momentum = rotations(start)[0].apply(start.omega_body[0] * [i1, i1, i3])
    about = Rotation.from_rotvec(np.outer(TIMES, momentum / i1))
    own = np.outer(TIMES * float(top.spin) * (i1 - i3) / i1, [0, 0, 1])
    exact = about * rotations(start)[0] * Rotation.from_rotvec(own)
    assert (rotations(motion) * exact.inv()).magnitude().max() < 1e-7


@given(tops())
def test_told_by_its_other_end_it_is_the_same_top(top: HeavyTop) -> None:
    """Turn the body's axes half round: theta, spin and weight are told from the other side."""
    other = replace(
        top,
        theta=np.pi - top.theta,
        phi=top.phi + np.pi,
        theta_rate=-top.theta_rate,
        weight_moment=-top.weight_moment,
        spin=-top.spin,
        psi=-top.psi,
    )
    one, two = heavy_top_motion(top, TIMES), heavy_top_motion(other, TIMES)
    axis_one, axis_two = (rotations(m).apply([0.0, 0.0, 1.0]) for m in (one, two))
    np.testing.assert_allclose(axis_one, -axis_two, rtol=0, atol=1e-6)


@given(tops())
def test_scaling_mass_changes_nothing_and_scaling_time_the_rates(top: HeavyTop) -> None:
    heavier = replace(
        top,
        transverse_moment=4 * top.transverse_moment,
        axial_moment=4 * top.axial_moment,
        weight_moment=4 * top.weight_moment,
    )
    faster = replace(
        top,
        weight_moment=4 * top.weight_moment,
        theta_rate=2 * top.theta_rate,
        phi_rate=2 * top.phi_rate,
        spin=2 * top.spin,
    )
    motion = heavy_top_motion(top, TIMES)
    # powers of two: nothing is rounded differently
    assert np.array_equal(motion.attitude, heavy_top_motion(heavier, TIMES).attitude)
    assert np.array_equal(motion.attitude, heavy_top_motion(faster, TIMES / 2).attitude)


@given(tops())
def test_the_axis_stays_between_its_turning_angles(top: HeavyTop) -> None:
    motion = heavy_top_motion(top, np.linspace(-7, 7, 60))
    least, greatest = turning_angles(nutation_of(top))
    slack = 4e-15
    assert np.all(motion.theta >= least * (1 - slack))
    assert np.all(motion.theta <= greatest * (1 + slack))
    assert least <= top.theta * (1 + slack)
    assert top.theta <= greatest * (1 + slack) + 1e-60
    assert 0 <= least <= greatest <= np.pi


@given(tops())
def test_every_top_has_an_answer_without_a_nan_or_warning(top: HeavyTop) -> None:
    motion = heavy_top_motion(top, TIMES)
    for name in ("theta", "phi", "psi", "attitude", "omega_body", "turning_angle"):
        assert np.all(np.isfinite(getattr(motion, name))), name
    assert motion.nutation_period > 0
    assert np.isfinite(motion.precession_rate)
    assert motion.nutation_period == nutation_period(nutation_of(top))
    assert motion.precession_rate == mean_precession_rate(top, nutation_of(top))
    np.testing.assert_allclose(np.sum(motion.attitude**2, axis=-1), 1.0, rtol=2e-15)
