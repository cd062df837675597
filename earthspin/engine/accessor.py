"""`ds.earthspin`: what an answer knows of itself, registered with the first answer.

``import earthspin.engine.accessor`` registers it without an answer.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from importlib import import_module
from itertools import product
from typing import TYPE_CHECKING, Any

import xarray as xr

import earthspin
from earthspin.engine.plan import Plan, plan_parts, scene_of, seconds_of
from earthspin.engine.spread import quantiles, sensitivity
from earthspin.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd
    from astropy.coordinates import SkyCoord
    from astropy.utils.iers import IERS_A

    from earthspin.engine.question import Question

#: Ends of the names of errors, which stand beside their values.
_ERROR = "_error"
_NO_VECTOR = "the answer has no vector along the axes of the GCRS"


@xr.register_datatree_accessor("earthspin")  # type: ignore[no-untyped-call]
@xr.register_dataset_accessor("earthspin")  # type: ignore[no-untyped-call]
class Answer:
    """What an answer of earthspin knows of itself.

    Attributes
    ----------
    scene : Question
        The question that made it, complete with every number.
    plan : Plan
        What ran for it and what was left out and why; with seconds if it ran in this process.

    Examples
    --------
    >>> import earthspin
    >>> answer = earthspin.precession(perturbers="sun")
    >>> print(answer.earthspin.scene.word, answer.earthspin.plan.left_out["seasons"], sep=": ")
    precession: the moon is not among the perturbers
    """

    def __init__(self, answer: xr.Dataset | xr.DataTree) -> None:
        self._dataset = answer.to_dataset() if isinstance(answer, xr.DataTree) else answer

    @property
    def scene(self) -> Question:
        """The question that made it, complete."""
        question: Question = earthspin.load_scene(self._dataset)
        return question

    @property
    def plan(self) -> Plan:
        """What ran for it, and what was left out and why."""
        seconds = seconds_of(scene_of(self._dataset))
        return replace(plan_parts(self.scene), seconds=dict(seconds))

    def to_frame(self) -> pd.DataFrame:
        """Give a tidy table of pandas: a row for each label, a column for each number.

        The rows have the labels that most variables have. Further labels, and vectors along
        `component`, `quaternion` and `axis`, become columns; each error follows its value. Numbers
        without labels are left out where others have labels.

        Returns
        -------
        DataFrame

        Examples
        --------
        >>> import earthspin
        >>> frame = earthspin.precession().earthspin.to_frame()
        >>> print(frame[["perturber", "precession_period"]].round(1).to_string(index=False))
        perturber  precession_period
              sun            81259.1
             moon            37613.9
            total            25712.1
        """
        spread = _spread(self._dataset)
        names: list[str] = []
        for name in (str(n) for n, v in spread.data_vars.items() if v.ndim or not spread.sizes):
            beside = [str(n) for n in spread.data_vars if str(n).startswith(f"{name}{_ERROR}")]
            names += [n for n in (name, *beside) if n not in names]
        if not spread.sizes:  # an answer without labels is one row
            return spread.expand_dims("row").to_dataframe().reset_index(drop=True)[names]
        frame = spread.to_dataframe()
        return frame.reset_index()[[*map(str, frame.index.names), *names]]

    def to_skycoord(self, name: str = "") -> SkyCoord:
        """Give unit vectors as coordinates of astropy, in the ICRS.

        The axes of the GCRS are those of the ICRS; no aberration is added.

        Parameters
        ----------
        name : str
            A variable along `component`, such as ``"pole"`` of `long_term`; not needed where
            `X`, `Y` and `Z` are the answer, as of `pole`.

        Raises
        ------
        SceneError
            If that is no vector along the axes of the GCRS.

        Examples
        --------
        >>> import earthspin
        >>> past = earthspin.long_term("-3000-01-01", "0 kyr", "1 kyr")
        >>> pole = past.earthspin.to_skycoord("pole")
        >>> print(f"{pole[0].ra.deg:.1f} {pole[0].dec.deg:.1f}")
        212.4 63.3
        """
        from astropy.coordinates import SkyCoord

        data = self._dataset
        if not isinstance(name, str):
            raise SceneError("to_skycoord", name, "give the name of a vector")
        if not name and {"X", "Y", "Z"} <= set(data.data_vars):
            x, y, z = (data[axis] for axis in "XYZ")
        elif name in data.data_vars and "component" in data[name].dims:
            x, y, z = (data[name].sel(component=axis, drop=True) for axis in "xyz")
        else:
            vectors = [
                str(n)
                for n, array in data.data_vars.items()
                if "component" in array.dims and array.attrs.get("frame") == "GCRS"
            ]
            allowed = f"name a vector: {', '.join(vectors)}" if vectors else _NO_VECTOR
            raise SceneError("to_skycoord", name, allowed)
        if x.attrs.get("frame") != "GCRS":
            raise SceneError("to_skycoord", name, _NO_VECTOR)
        coordinates = SkyCoord(
            x=x.values, y=y.values, z=z.values, representation_type="cartesian", frame="icrs"
        )
        coordinates.representation_type = "unitspherical"
        return coordinates

    def to_iers_table(self) -> IERS_A:
        """Give a table of Earth orientation of astropy from an answer of `forecast`.

        Polar motion and celestial pole offsets are observed up to the origin and forecast after
        it, day by day and without errors. UT1 - UTC is that of finals2000A. Dates outside the table
        are refused, also where astropy only warns.

        Returns
        -------
        astropy.utils.iers.IERS_A

        Raises
        ------
        SceneError
            If it is another answer, if the forecast used polar motion without a table, or if it
            reaches farther than the UT1 - UTC of finals2000A.

        Examples
        --------
        >>> import earthspin
        >>> from astropy.utils import iers
        >>> table = earthspin.forecast(90).earthspin.to_iers_table()
        >>> with iers.earth_orientation_table.set(table):
        ...     pass  # transformations of astropy.coordinates
        """
        question = self.scene
        if question.word != "forecast":
            problem = f"an answer of '{question.word}' has no table; give one of 'forecast'"
            raise SceneError("to_iers_table", question.word, problem)
        forecast = import_module("earthspin.questions.forecast")  # which stands above the engine
        return forecast.iers_table(question)

    def quantiles(self, shares: Sequence[float] = (0.025, 0.5, 0.975)) -> xr.Dataset:
        """Quantiles of an ensemble.

        Parameters
        ----------
        shares : sequence of float
            Between 0 and 1; by default the ends of the central 95 % and its middle.

        Returns
        -------
        Dataset
            Each number that differs among the members, along `quantile` instead of `member`.

        Raises
        ------
        SceneError
            If it is no ensemble, or a share is not between 0 and 1.

        Examples
        --------
        >>> import earthspin
        >>> earths = earthspin.ensemble("precession", 1000)
        >>> period = earths.earthspin.quantiles().precession_period.sel(perturber="total")
        >>> print(period.round(2).values)
        [25712.07 25712.08 25712.1 ]
        """
        return quantiles(self._dataset, shares)

    def sensitivity(self) -> xr.Dataset:
        """How much each input of an ensemble has to do with each number of its answer.

        Straight lines in all inputs are fitted together (`numerics.sampling`). An input that is no
        number, such as the table of an orbit, has its classes: their share is that of the variance
        between the means of their members (eta squared), and there is no slope, NaN.

        Returns
        -------
        Dataset
            Along `input`: for each number ``<name>_slope``, its change per unit of the input, and
            ``<name>_share``, the share of its variance; and ``<name>_unexplained``, the share that
            straight lines leave.

        Raises
        ------
        SceneError
            If it is no ensemble, or has too few members: two more than there are inputs, an input
            in words counting for as many as there are of these, less one.

        Examples
        --------
        >>> import earthspin
        >>> earths = earthspin.ensemble("precession", 1000)
        >>> share = earths.earthspin.sensitivity().precession_period_share.sel(perturber="total")
        >>> print(float(share.sel(input="body.dynamical_flattening").round(3)))
        1.0
        """
        return sensitivity(self._dataset)

    def plot(self) -> Any:
        """Draw the figures that belong to the question.

        Returns
        -------
        list of Figure

        Raises
        ------
        SceneError
            If it is a part of an answer that cannot be drawn alone.

        Examples
        --------
        >>> import earthspin
        >>> year = earthspin.torque_series("2026-01-01", "2027-01-01", "6 h")
        >>> year.earthspin.plot()[0].savefig("torque.png")
        """
        views = import_module("earthspin.views.of_question")  # which stands above the engine
        if figures := views.figures_of_fit(self._dataset):
            return figures
        whole = self.scene
        try:
            return views.figures_of(self._dataset)
        except (AttributeError, KeyError, ValueError):
            what = f"a part of the answer to '{whole.word}'"
            raise SceneError("plot", what, "draw the whole: earthspin.run(ds)") from None


def _spread(dataset: xr.Dataset) -> xr.Dataset:
    """Variables with the dimensions that most have; one for each label of any other dimension."""
    columns: dict[str, xr.DataArray] = {}
    common = Counter(
        frozenset(array.dims).difference(("component", "quaternion", "axis"))
        for array in dataset.data_vars.values()
        if array.ndim
    )
    rows = common.most_common(1)[0][0] if common else frozenset()
    for name, array in dataset.data_vars.items():
        along = [str(dim) for dim in array.dims if dim not in rows]
        for labels in product(*(array[dim].values for dim in along)):
            column = array.sel(dict(zip(along, labels, strict=True)), drop=True)
            columns["_".join([str(name), *map(str, labels)])] = column
    return xr.Dataset(columns)
