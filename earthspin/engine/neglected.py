"""Sizes of the effects that a model neglects; they are not included in the errors of results."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Self

import numpy as np

from earthspin.constants import Constant
from earthspin.engine.labels import from_si
from earthspin.engine.variables import Labels, Value, Variables, labels, number

if TYPE_CHECKING:
    import xarray as xr


def largest_of(text: str) -> tuple[str, float, str] | None:
    """Read name, size and unit of the largest effect from the text that `Neglected.largest` writes.

    The result is None if the text gives no size.
    """
    written = re.match(r"([^:]+): ([-+.e\d]+) ([^(]+) \(", text)
    return None if written is None else (written[1], float(written[2]), written[3])


def error_of(answer: xr.Dataset, headline: str) -> str:
    """Name of the variable with the error of the headline number; empty if it has no error."""
    if headline.endswith("_error") or headline not in answer:
        return headline
    return str(answer[headline].attrs.get("ancillary_variables", "")).split(" ")[0]


BOUND = "this is a bound on a neglected effect, or its published size"


@dataclass(frozen=True)
class Neglected:
    """Sizes of the effects that a model neglects, with their source.

    Attributes
    ----------
    sizes : mapping of str to float
        Size of each effect, SI.
    unit : str
        Unit of the sizes in results.
    what : str
        Meaning of the sizes in plain words; without sizes, the neglected effect.
    source : str
        Source of the sizes.
    unknown : str
        Further neglected effects of unknown size.
    periodic : tuple of str
        Effects with a size that vanish in the mean over their period, which the answer gives.
    """

    sizes: Mapping[str, float] = field(default_factory=dict)
    unit: str = "1"
    what: str = "nothing that has a known size"
    source: str = ""
    unknown: str = ""
    periodic: tuple[str, ...] = ()

    @classmethod
    def cited(cls, sizes: Mapping[str, Constant], what: str) -> Self:
        """Make a `Neglected` from sizes given as constants, each with its own source."""
        (unit,) = {size.unit for size in sizes.values()}
        return cls(
            {name: size.value / from_si(unit) for name, size in sizes.items()},
            unit,
            what,
            "; ".join(f"{name}: {size.source}" for name, size in sizes.items()),
        )

    def also(self, effect: str) -> Self:
        """Add a neglected effect of unknown size; an empty text adds nothing."""
        if not effect:
            return self
        # without sizes, `what` names the neglected effect
        known = self.what if not self.sizes and self.what != Neglected.what else ""
        unknown = ", ".join(filter(None, (self.unknown or known, effect)))
        return replace(self, unknown=unknown)

    @property
    def largest(self) -> str:
        """Describe the largest neglected effect, with its size, for the attributes of a result."""
        unknown = f"of unknown size: {self.unknown}" if self.unknown else ""
        if not self.sizes:
            return unknown or self.what
        name = max(self.sizes, key=lambda effect: abs(self.sizes[effect]))
        shown = self.sizes[name] * from_si(self.unit)
        known = f"{name}: {shown:.3g} {self.unit} ({self.what})"
        return f"{known}; {unknown}" if unknown else known

    def dataset(self, effects: Sequence[str] = ()) -> xr.Dataset:
        """Return the sizes as a Dataset along `effect`, with the largest effect first.

        Parameters
        ----------
        effects : sequence of str
            Labels that the answer has along `effect`; included effects have size 0.
        """
        names = list(effects) or sorted(self.sizes, key=lambda effect: -abs(self.sizes[effect]))
        notes = {
            "references": self.source,
            "of_unknown_size": self.unknown,
            "zero_in_the_mean": "; ".join(self.periodic),
        }
        attrs = {name: words for name, words in notes.items() if words}

        class Effects(Variables, along=("effect",), no_error=BOUND):
            """Variables of the dataset of neglected effects."""

            neglected_effect: Value = number(self.unit, self.what)
            effect: Labels = labels()

        sizes = [float(self.sizes.get(name, 0.0)) for name in names]
        laid = Effects(neglected_effect=sizes, effect=np.array(names, dtype=str))
        return laid.with_attributes(neglected_effect=attrs).dataset()
