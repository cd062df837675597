"""What the ladder leaves out, found again by a larger system and by the slope of the ladder."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.optimize import brentq

import earthspin
from earthspin import EARTH
from earthspin.interior.equilibrium import figure
from earthspin.interior.layers import PREM
from earthspin.interior.love import elastic
from earthspin.interior.modes import all_fluid, free_modes, parts_of
from earthspin.interior.named import INTERIORS
from earthspin.mass.figure import ellipticity_from_h
from tests import shipped

#: k21 of an elastic Earth, IERS Conventions (2010), table 6.3.
K21 = 0.29470
SIDEREAL_DAY = 0.99726966
LEFT_OUT = INTERIORS["prem"].neglected


@dataclass(frozen=True)
class Earth:
    """Shape and compliances of PREM as Mathews et al. 1991 give them (not verified)."""

    e: float = 1 / 304.456
    e_f: float = 2.548e-3
    e_s: float = 2.422e-3
    fluid: float = 0.113066
    solid: float = 7.3059e-4
    kappa: float = 1.039e-3
    xi: float = 2.222e-4
    zeta: float = 4.964e-9
    gamma: float = 1.965e-3
    beta: float = 6.16e-4
    delta: float = -4.869e-7
    theta: float = 6.794e-6
    chi: float = -7.536e-5
    nu: float = 7.984e-5
    alpha_1: float = 0.9463
    alpha_2: float = 0.8294
    alpha_3: float = 0.0537

    def with_inner_core(self, s: float) -> float:
        """Determinant of the free motion of mantle, fluid core and inner core."""
        share, lever = self.solid / self.fluid, self.alpha_1 * self.e_s
        pull = self.alpha_3 * self.e_s
        rows = [
            [
                s - self.e + (1 + s) * self.kappa,
                (1 + s) * (self.fluid + self.xi),
                (1 + s) * (self.solid + self.zeta),
                (1 + s) * self.solid * pull,
            ],
            [
                s * (1 + self.gamma),
                1 + s * (1 + self.beta) + self.e_f,
                s * self.delta,
                -s * lever * share,
            ],
            [
                s * (1 + self.theta) - pull,
                s * self.chi + lever,
                1 + s * (1 + self.nu),
                (1 + s - self.alpha_2) * self.e_s,
            ],
            [0.0, 0.0, 1.0, s],
        ]
        return float(np.linalg.det(np.array(rows)))

    def all_fluid(self, s: float) -> float:
        """The same of mantle and a core that is fluid to the centre."""
        mantle = s - self.e + (1 + s) * self.kappa
        core = 1 + s * (1 + self.beta) + self.e_f
        whole = self.fluid + self.solid + self.xi
        return mantle * core - (1 + s) * whole * s * (1 + self.gamma)

    def shift(self) -> float:
        """Change of the period of the free wobble by the inner core, d."""
        solid, fluid = (
            SIDEREAL_DAY / brentq(of, 1 / 600, 1 / 330, xtol=1e-14)
            for of in (self.with_inner_core, self.all_fluid)
        )
        return float(solid - fluid)


@pytest.mark.parametrize("ocean", [0.0, 0.0453])
def test_a_solid_inner_core(ocean: float) -> None:
    """Measured: -0.024 d without an ocean, -0.028 d with one."""
    earth = Earth()
    wet = replace(earth, kappa=earth.kappa * (1 + ocean / 0.2983))
    assert wet.shift() == pytest.approx(LEFT_OUT["a solid inner core"].value, rel=0, abs=0.007)


def beside_a_core_that_ends_there() -> float:
    """Change of the period by the inner core where the fluid ends at its boundary, d."""
    earth = Earth()
    fluid = brentq(replace(earth, solid=0.0).all_fluid, 1 / 600, 1 / 330, xtol=1e-14)
    whole = brentq(earth.with_inner_core, 1 / 600, 1 / 330, xtol=1e-14)
    return float(SIDEREAL_DAY * (1 / whole - 1 / fluid))


def test_a_solid_inner_core_beside_a_core_that_ends_there() -> None:
    """-0.348 d, by published compliances."""
    assert beside_a_core_that_ends_there() == pytest.approx(-0.35, rel=0, abs=0.005)


def test_inner_cores_of_our_own_layers() -> None:
    """-0.35 d from bound to free, -0.02 from fluid to free."""
    spin_rate = float(EARTH.spin_rate)
    e = float(ellipticity_from_h(EARTH.dynamical_flattening))
    free = parts_of(PREM, spin_rate, elastic(PREM).response, e)
    products = np.array(free.inertia)
    products[2, :] = products[:, 2] = 0
    none = dict.fromkeys(("e_s", "inner", "a1", "a2", "a3", "k_icb"), 0.0)
    bound = replace(free, inertia=products, **none)
    fluid = all_fluid(free, figure(PREM, spin_rate).e_core)
    periods = [
        SIDEREAL_DAY / free_modes(parts)["chandler_wobble"].real for parts in (free, bound, fluid)
    ]
    assert periods[0] - periods[1] == pytest.approx(-0.35, rel=0, abs=0.005)
    assert periods[0] - periods[2] == pytest.approx(-0.024, rel=0, abs=0.003)


def test_rotation_and_ellipticity_in_the_love_number() -> None:
    """Measured: -2.71 d."""
    sensitivity = shipped.tree("wobble")["sensitivity"].sel(input="k2")
    days = float(sensitivity.days_per_unit) * (K21 - float(sensitivity.input_value))
    told = LEFT_OUT["rotation and ellipticity in the Love number"].value
    assert days == pytest.approx(told, rel=0, abs=0.05)


@pytest.mark.parametrize(
    ("body", "told"),
    [
        (EARTH.replace(spin_period="20 h"), "were not found for this earth"),
        (earthspin.MARS, "were not found for this mars"),
    ],
)
def test_no_size_is_told_of_another_body(body: earthspin.Body, told: str) -> None:
    assert earthspin.wobble_ladder(body=body).attrs["neglected"].endswith(told)
