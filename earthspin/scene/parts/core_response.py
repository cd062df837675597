"""What the inside of the body makes of rigid nutation: a resonance, and what it adds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import needs_nonrigid

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from earthspin.compare.nutation import Circles
    from earthspin.compare.response import Response
    from earthspin.scene.spec import Scene


def fit_core(scene: Scene, given: Mapping[str, Any]) -> Response:
    """Resonance form through the ratios of the largest terms."""
    import numpy as np

    from earthspin.compare.response import SUN_SYNCHRONOUS, fit_response

    done = given["pole-analysis"]
    ours, theirs = done.our_circles, done.their_circles
    used = np.any(ours.multiples != SUN_SYNCHRONOUS, axis=1)
    return fit_response(
        ours.frequency[used],
        ours.amplitude[used],
        theirs.amplitude[used],
        float(scene.body.dynamical_flattening),
        float(scene.body.spin_rate),
    )


@dataclass(frozen=True)
class Shift:
    """What the non-rigid response adds to the figure and rotation axes."""

    circles: Circles

    def eta(self, days: NDArray[np.float64]) -> Any:
        """Shift as dpsi sin(eps0) + i deps, rad."""
        from earthspin.sky import iau

        return self.circles.at(iau.delaunay_arguments(days))

    def apply(self, axes: dict[str, NDArray[np.float64]], days: NDArray[np.float64]) -> None:
        """Move the axes of the mantle in place; the angular momentum is not changed."""
        from earthspin.sky.iau import moved_by_nutation

        eta = self.eta(days)
        for name in ("rotation", "figure"):
            axes[name] = moved_by_nutation(axes[name], eta, days)


def nonrigid_shift(scene: Scene, given: Mapping[str, Any]) -> Shift:
    """Non-rigid less rigid nutation, as a sum of circles."""
    from dataclasses import replace

    circles, response = given["pole-analysis"].our_circles, given["core-response"]
    factor = response.transfer(circles.frequency) - 1
    return Shift(replace(circles, amplitude=circles.amplitude * factor))


def core_resonance(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """The free core nutation that the ratios imply."""
    import numpy as np

    from earthspin.dataset import build

    done, response = given["pole-analysis"], given["core-response"]
    ours, theirs = done.our_circles, done.their_circles
    left = theirs.amplitude - response.transfer(ours.frequency) * ours.amplitude
    return build(
        "core-resonance",
        CORE_RESONANCE.gives,
        {
            "core_nutation_period": response.period,
            "core_nutation_quality": response.quality,
            "strength_real": response.strengths.real,
            "strength_imaginary": response.strengths.imag,
            "response_rms": float(np.sqrt(np.mean(np.abs(left) ** 2))),
            "response_maximum": float(np.max(np.abs(left))),
        },
        coords={"mode": ["constant", "chandler", "core", "inner-core"]},
    )


CORE_RESPONSE = Part(
    name="core-response",
    does="resonance form fitted to IAU 2000A over our rigid amplitudes",
    function="earthspin.scene.parts.core_response:fit_core",
    needs=("pole-analysis",),
    left_out=needs_nonrigid,
)

NONRIGID_SHIFT = Part(
    name="nonrigid-shift",
    does="what the fluid core and the yielding mantle add to the rigid nutations",
    function="earthspin.scene.parts.core_response:nonrigid_shift",
    needs=("core-response",),
    left_out=needs_nonrigid,
)

CORE_RESONANCE = Part(
    name="core-resonance",
    does="period and quality of the free core nutation recovered from IAU 2000A",
    function="earthspin.scene.parts.core_response:core_resonance",
    needs=("pole-analysis", "core-response"),
    gives={
        "core_nutation_period": Variable((), "d", "period of the free core nutation in space"),
        "core_nutation_quality": Variable((), "1", "quality factor of the free core nutation"),
        "strength_real": Variable(("mode",), "1", "fitted strength, real part"),
        "strength_imaginary": Variable(("mode",), "1", "fitted strength, imaginary part"),
        "response_rms": Variable((), "uas", "root mean square of what the response leaves"),
        "response_maximum": Variable((), "uas", "largest that the response leaves"),
    },
)
