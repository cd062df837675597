"""The largest terms of nutation, ours beside the IAU's."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene

#: The terms of the nutation table.
LARGEST = 30


def nutation_table(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """The largest circular terms of both poles, their ratio, and what the response leaves."""
    import numpy as np

    from earthspin.compare.nutation import phases
    from earthspin.dataset import build

    done, response = given["pole-analysis"], given["core-response"]
    ours, theirs = done.our_circles, done.their_circles
    order = np.argsort(-np.abs(ours.amplitude))[:LARGEST]
    rigid, real = ours.amplitude[order], theirs.amplitude[order]
    transfer = response.transfer(ours.frequency[order])
    values: dict[str, Any] = {"period": 2 * np.pi / ours.frequency[order]}
    for name, amplitude in (("rigid", rigid), ("iau", real), ("left", real - transfer * rigid)):
        values[f"{name}_in_phase"], values[f"{name}_out_of_phase"] = phases(amplitude)
    ratio = real / rigid
    values |= {
        "ratio_in_phase": ratio.real,
        "ratio_out_of_phase": ratio.imag,
        "transfer_in_phase": transfer.real,
        "transfer_out_of_phase": transfer.imag,
    }
    labels = [" ".join(f"{m:+d}" for m in multiple) for multiple in ours.multiples[order]]
    return build("nutation-table", NUTATION_TABLE.gives, values, coords={"term": labels})


_TERM = ("term",)

NUTATION_TABLE = Part(
    name="nutation-table",
    does="the thirty largest circular terms of both poles, and their ratio",
    function="earthspin.scene.parts.nutation_terms:nutation_table",
    needs=("pole-analysis", "core-response"),
    gives={
        "period": Variable(_TERM, "d", "period of the circle in space, negative if retrograde"),
        "rigid_in_phase": Variable(_TERM, "mas", "our rigid amplitude, in phase"),
        "rigid_out_of_phase": Variable(_TERM, "mas", "our rigid amplitude, out of phase"),
        "iau_in_phase": Variable(_TERM, "mas", "amplitude of IAU 2000A, in phase"),
        "iau_out_of_phase": Variable(_TERM, "mas", "amplitude of IAU 2000A, out of phase"),
        "ratio_in_phase": Variable(_TERM, "1", "IAU 2000A over ours, real part"),
        "ratio_out_of_phase": Variable(_TERM, "1", "IAU 2000A over ours, imaginary part"),
        "transfer_in_phase": Variable(_TERM, "1", "fitted resonance form, real part"),
        "transfer_out_of_phase": Variable(_TERM, "1", "fitted resonance form, imaginary part"),
        "left_in_phase": Variable(_TERM, "uas", "IAU less response times ours, in phase"),
        "left_out_of_phase": Variable(_TERM, "uas", "IAU less response times ours, out of phase"),
    },
)
