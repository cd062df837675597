"""What a model leaves out, named with its size; it never hides in an error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Self

import numpy as np

from earthspin.constants import Constant
from earthspin.engine.labels import from_si
from earthspin.engine.variables import Labels, Value, Variables, labels, number

if TYPE_CHECKING:
    import xarray as xr


BOUND = "a bound, or a published size, of what is left out"


@dataclass(frozen=True)
class Neglected:
    """Sizes of what is left out.

    Attributes
    ----------
    sizes : mapping of str to float
        By effect, SI.
    unit : str
        In which they are shown.
    what : str
        What the sizes are of, in plain words; without sizes, what is left out.
    source : str
        Where they come from.
    unknown : str
        What is left out besides, whose size is not known.
    """

    sizes: Mapping[str, float] = field(default_factory=dict)
    unit: str = "1"
    what: str = "nothing that has a known size"
    source: str = ""
    unknown: str = ""

    @classmethod
    def cited(cls, sizes: Mapping[str, Constant], what: str) -> Self:
        """Sizes that each have a source, all of one unit."""
        (unit,) = {size.unit for size in sizes.values()}
        return cls(
            {name: size.value / from_si(unit) for name, size in sizes.items()},
            unit,
            what,
            "; ".join(f"{name}: {size.source}" for name, size in sizes.items()),
        )

    @property
    def largest(self) -> str:
        """Name of the largest effect with its size, for the answer's attributes."""
        unknown = f"of unknown size: {self.unknown}" if self.unknown else ""
        if not self.sizes:
            return unknown or self.what
        name = max(self.sizes, key=lambda effect: abs(self.sizes[effect]))
        shown = self.sizes[name] * from_si(self.unit)
        known = f"{name}: {shown:.3g} {self.unit} ({self.what})"
        return f"{known}; {unknown}" if unknown else known

    def dataset(self, effects: Sequence[str] = ()) -> xr.Dataset:
        """Give `neglected_effect` along `effect`, the largest first.

        Parameters
        ----------
        effects : sequence of str
            Labels that the answer has along `effect`; what is not left out then has size 0.
        """
        names = list(effects) or sorted(self.sizes, key=lambda effect: -abs(self.sizes[effect]))
        notes = {"references": self.source, "of_unknown_size": self.unknown}
        attrs = {name: words for name, words in notes.items() if words}

        class Effects(Variables, along=("effect",), no_error=BOUND):
            """Sizes by effect."""

            neglected_effect: Value = number(self.unit, self.what)
            effect: Labels = labels()

        sizes = [float(self.sizes.get(name, 0.0)) for name in names]
        laid = Effects(neglected_effect=sizes, effect=np.array(names, dtype=str))
        return laid.with_attributes(neglected_effect=attrs).dataset()
