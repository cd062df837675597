"""Accessor `ds.earthspin` of result Datasets, available once a first result exists.

``import earthspin.engine.accessor`` registers it without an answer.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from types import MethodType
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from earthspin._lazy import METHODS, registered
from earthspin.engine import atomic_writes
from earthspin.engine.members import MEMBER
from earthspin.engine.origin import without_lost_units
from earthspin.engine.question import ALL, names_in
from earthspin.engine.variables import from_si, places, texts_as_columns, with_units_of_answers
from earthspin.errors import SceneError, Where, nearest
from earthspin.numerics import sampling
from earthspin.units import as_written, quantity, real_numbers, time_scale

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import pandas as pd
    from astropy.coordinates import SkyCoord

    from earthspin.engine.question import Question

#: Suffix of the names of errors.
_ERROR = "_error"
_SHARE_ERROR = "95 % half-width, from the number of members, of the share of the variance"
_NO_VECTOR = "the answer has no vector in the GCRS"


@xr.register_datatree_accessor("earthspin")  # type: ignore[no-untyped-call]
@xr.register_dataset_accessor("earthspin")  # type: ignore[no-untyped-call]
class Answer:
    """Accessor `ds.earthspin` of a result Dataset: inputs, plan, tables, statistics and figures.

    Packages above the engine register further methods: `plot` of all answers, `to_iers_table` of a
    forecast.

    Attributes
    ----------
    dataset : Dataset
        The answer itself, or the section that a node of a tree holds.
    scene : Question
        The question of this answer, with every number.
    plan : Plan
        Plan of the question: parts that run, and parts that are left out, with the reasons. The
        node ``plan`` of `run_tree` has the run times.

    Examples
    --------
    >>> import earthspin
    >>> answer = earthspin.precession(perturbers="sun")
    >>> print(answer.earthspin.scene.word, answer.earthspin.plan.left_out["seasons"], sep=": ")
    precession: the moon is not among the perturbers
    """

    def __init__(self, answer: xr.Dataset | xr.DataTree) -> None:
        self._data = answer
        self._sections = answer.children if isinstance(answer, xr.DataTree) else {}

    @property
    def dataset(self) -> xr.Dataset:
        """The answer itself, with units spelled as in answers if xarray has opened a file."""
        data = self._data
        return with_units_of_answers(
            _without_inherited(data) if isinstance(data, xr.DataTree) else data
        )

    def __getattr__(self, name: str) -> Any:
        """Return a method that another module defines; the module is imported on first use."""
        if name not in METHODS:
            raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'")
        return MethodType(registered(name), self)

    def __dir__(self) -> list[str]:
        """List the names of all attributes, including the methods that other modules define."""
        return [*super().__dir__(), *METHODS]

    @property
    def scene(self) -> Question:
        """Computation (`Question`) whose result is this Dataset, with the values of all inputs."""
        question: Question = registered("load_scene")(self.dataset)
        return question

    @property
    def plan(self) -> Any:
        """Plan of the computation: functions that run, and functions left out, with reasons."""
        return registered("plan")(self.scene)

    def section(self, name: str) -> xr.Dataset:
        """Return one section of an answer as a Dataset; compute it if there is no tree.

        A node of a tree inherits the coordinates of the root, by which a table of it would repeat
        each row. The Dataset has only those along its own dimensions.

        Parameters
        ----------
        name : str
            Such as ``"seasons"``, or ``"plan"``.

        Returns
        -------
        Dataset

        Raises
        ------
        SceneError
            If the tree or the question has no such section.

        Examples
        --------
        >>> import earthspin
        >>> tree = earthspin.run_tree("precession", sections="seasons")
        >>> print(tree.earthspin.section("seasons").time_per_degree.round(2).values)
        71.59
        """
        if isinstance(self._data, xr.Dataset):
            return registered("run_tree")(self._data, name).earthspin.section(name)  # type: ignore[no-any-return]
        if not isinstance(name, str) or name not in self._sections:  # type: ignore[redundant-expr]
            problem = f"no such section; {nearest(name, self._sections)}; run_tree computes more"
            raise SceneError("section", name, problem)
        return _without_inherited(self._sections[name])

    def to_frame(
        self,
        columns: str | Sequence[str] = ALL,
        *,
        section: str = "",
        units: Mapping[str, str] | None = None,
        wrap: str | Sequence[str] = (),
    ) -> pd.DataFrame:
        """Return the result as a pandas table: a row for each label, a column for each number.

        The rows are labelled by the dimensions that most variables have. Further dimensions,
        including `component`, `quaternion` and `axis`, become columns. Each error follows its
        value. If some variables have dimensions, those without are omitted, but for numbers with
        an error, such as a fitted period, which are repeated in each row.

        Parameters
        ----------
        columns : str or sequence of str
            Names of variables, each of which comes with its own errors, or of single columns such
            as ``"pole_x"``; by default all.
        section : str
            Section to take in place of the answer; it is computed if it is missing.
        units : mapping of str to str, optional
            Other units of variables and labels, such as ``{"x": "mas", "epoch": "kyr"}``; errors
            have the unit of their variable. Epochs also count backwards from 1950 (``"kyr BP"``) or
            from 2000 (``"ka"``).
        wrap : str or sequence of str
            Angles that wind up, such as ``"longitude_of_perihelion"``, to give from 0 to one turn.

        Returns
        -------
        DataFrame

        Raises
        ------
        SceneError
            If the result has no such column, section or angle.
        UnitsError
            If a unit has the wrong dimension.

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
        main = isinstance(section, str) and not section  # type: ignore[redundant-expr]
        data = self.dataset if main else self.section(section)
        spread, owners = _spread(without_lost_units(data))
        requested = names_in(columns, "columns")
        if requested == [ALL]:
            fitted = {n for n, v in spread.data_vars.items() if "ancillary_variables" in v.attrs}
            fitted |= {e for n in fitted for e in spread[n].attrs["ancillary_variables"].split()}
            requested = [
                str(n)
                for n, v in spread.data_vars.items()
                if v.ndim or not spread.sizes or n in fitted
            ]
        names: list[str] = []
        for name in requested:
            own = [c for c in owners if name in (c, owners[c]) or c.startswith(f"{name}{_ERROR}")]
            if not own and name not in spread.dims:
                raise SceneError("columns", name, nearest(name, map(str, data.variables)))
            names += [column for column in own if column not in names]
        if spread.sizes:
            frame = spread.to_dataframe()
            names = [*map(str, frame.index.names), *names]
            frame = frame.reset_index()[names]
        else:  # an answer without dimensions is one row
            frame = spread.expand_dims("row").to_dataframe().reset_index(drop=True)[names]
        unit_of = {name: str(spread[name].attrs.get("units", "1")) for name in names}
        for name in names_in(wrap, "wrap"):
            if unit_of.get(name) not in ("deg", "rad", "arcsec", "mas"):
                raise SceneError("wrap", name, "it is no angle with a unit")
            frame[name] %= 2 * np.pi * from_si(unit_of[name])
        for name, unit in (units or {}).items():
            changed = [c for c in names if c == name or owners.get(c) == name]
            if not changed or unit_of[changed[0]] == "1":
                known = ", ".join(c for c in unit_of if unit_of[c] != "1")
                raise SceneError("units", name, f"columns with a unit: {known}")
            was = unit_of[changed[0]]
            scale = time_scale(unit) if (name, was) == ("epoch", "yr") else None
            where = Where(f"units of {name}")
            factor, origin = scale or (quantity(f"1 {unit}", was, where, f"1 {was}"), 0.0)
            changed += [c for c in names if c.startswith(name + _ERROR)]
            for column in (c for c in changed if unit_of[c] == was):
                # adding zero leaves no -0.0
                frame[column] = as_written(frame[column], 1 / factor, -origin / factor) + 0.0
                unit_of[column] = unit
        frame.attrs["units"] = unit_of
        return frame

    def to_csv(
        self,
        path: str | Path,
        columns: str | Sequence[str] | None = None,
        *,
        section: str = "",
        units: Mapping[str, str] | None = None,
        wrap: str | Sequence[str] = (),
    ) -> Path:
        """Write the table of `to_frame` as a CSV file, with units in the names of its columns.

        A column is named like ``obliquity (deg)``, and by its name alone if it has no unit, so that
        any program reads the file without options; ``name.split(" (")[0]`` is the plain name.

        Parameters
        ----------
        path : str or Path
        columns : str or sequence of str, optional
            As for `to_frame`; ``"all"`` for all. By default those that the question declares: of
            `long_term` obliquity, eccentricity, longitude of perihelion and climatic precession
            with their errors, of most questions all.
        section, units, wrap
            As for `to_frame`.

        Returns
        -------
        Path

        Raises
        ------
        SceneError
            If the result has no such column, section or angle.
        UnitsError
            If a unit has the wrong dimension.
        OutputError
            If the file cannot be written.

        Examples
        --------
        >>> import earthspin
        >>> past = earthspin.long_term("-2 kyr", "0 kyr", "1 kyr")
        >>> path = past.earthspin.to_csv("past.csv", "obliquity", units={"epoch": "kyr"})
        >>> print(path.read_text().splitlines()[0])
        epoch (kyr),obliquity (deg),obliquity_error (deg)
        """
        if columns is None:
            question = registered("QUESTIONS").get(self.dataset.attrs.get("compute"))
            declared = () if section else getattr(question, "csv_columns", ())
            columns = [name for name in declared if name in self.dataset] or ALL
        frame = self.to_frame(columns, section=section, units=units, wrap=wrap)
        own = frame.attrs["units"]
        header = [name if own[name] == "1" else f"{name} ({own[name]})" for name in frame]
        with atomic_writes.replacing(path) as draft:
            frame.to_csv(draft, index=False, header=header)
        return Path(path)

    def to_skycoord(self, name: str = "") -> SkyCoord:
        """Return the unit vectors of the result as astropy coordinates in the ICRS.

        The axes of the GCRS are parallel to those of the ICRS; no aberration is applied.

        Parameters
        ----------
        name : str
            A variable along `component`, such as ``"pole"`` of `long_term`; not needed for an
            answer with `X`, `Y` and `Z`, such as that of `pole`.

        Raises
        ------
        SceneError
            If the variable is not a vector in the GCRS.

        Examples
        --------
        >>> import earthspin
        >>> past = earthspin.long_term("-3000-01-01", "0 kyr", "1 kyr")
        >>> pole = past.earthspin.to_skycoord("pole")
        >>> print(f"{pole[0].ra.deg:.1f} {pole[0].dec.deg:.1f}")
        212.4 63.3
        """
        from astropy.coordinates import SkyCoord

        arrays = {str(n): a for n, a in self.dataset.items() if a.attrs.get("frame") == "GCRS"}
        vectors = [n for n, array in arrays.items() if "component" in array.dims]
        if not isinstance(name, str):
            raise SceneError("to_skycoord", name, f"name a vector: {', '.join(vectors)}")
        if name == "" and {"X", "Y", "Z"} <= arrays.keys():
            x, y, z = (arrays[axis] for axis in "XYZ")
        elif name in vectors:
            x, y, z = (arrays[name].sel(component=axis, drop=True) for axis in "xyz")
        else:
            allowed = f"name a vector: {', '.join(vectors)}" if vectors else _NO_VECTOR
            raise SceneError("to_skycoord", name, allowed)
        coordinates = SkyCoord(
            x=x.values, y=y.values, z=z.values, representation_type="cartesian", frame="icrs"
        )
        coordinates.representation_type = "unitspherical"
        return coordinates

    def quantiles(self, shares: Sequence[float] = (0.025, 0.5, 0.975)) -> xr.Dataset:
        """Return quantiles over the ensemble members, for each number along the dimension `member`.

        Parameters
        ----------
        shares : sequence of float
            Shares of the members below the quantile, between 0 and 1; by default the median and
            the ends of the central 95 % interval.

        Returns
        -------
        Dataset
            Every number with dimension `member`, along `quantile` instead.

        Raises
        ------
        SceneError
            If the answer is not an ensemble, or a share is not between 0 and 1.

        Examples
        --------
        >>> import earthspin
        >>> earths = earthspin.ensemble("precession", 1000)
        >>> period = earths.earthspin.quantiles().precession_period.sel(perturber="total")
        >>> print(period.round(2).values)
        [25712.07 25712.08 25712.1 ]
        """
        try:
            levels = np.atleast_1d(real_numbers(shares))
        except Exception:  # somebody's class may raise anything
            levels = np.empty(0)
        if not (levels.ndim == 1 and levels.size and ((levels >= 0) & (levels <= 1)).all()):
            raise SceneError("quantiles", shares, "give numbers between 0 and 1")
        variables = {}
        for name, array in _members(self.dataset, "quantiles").items():
            values = sampling.quantiles(array.values.astype(float), levels)
            variables[name] = (("quantile", *array.dims[1:]), values, array.attrs)
        attrs = {"long_name": "share of the members below", "units": "1"}
        labels = {"quantile": ("quantile", levels, attrs)} | _other_labels(self.dataset)
        return xr.Dataset(variables, labels, dict(self.dataset.attrs))

    def sensitivity(self) -> xr.Dataset:
        """Compute how much each ensemble input contributes to the variance of each result.

        The numbers are fitted by a linear function of all inputs (`numerics.sampling`). An input
        that is a name, such as an orbit table, divides the members into classes: its share is that
        of the variance between the means of the classes (eta squared), and its slope is NaN.

        Returns
        -------
        Dataset
            For each number, ``<name>_slope``, the change per unit of the input, and
            ``<name>_share``, the share of the variance, with its 95 % half-width
            ``<name>_share_error``, all along `input`; and ``<name>_unexplained``, the share of the
            variance that the fit does not explain. The error follows from the number of members;
            it holds for inputs drawn at random and results that are nearly linear in them.

        Raises
        ------
        SceneError
            If the answer is not an ensemble, or has too few members: at least 2 are needed, plus 1
            for each input that is a number, plus k - 1 for each input with k names.

        Examples
        --------
        >>> import earthspin
        >>> earths = earthspin.ensemble("precession", 1000)
        >>> share = earths.earthspin.sensitivity().precession_period_share.sel(perturber="total")
        >>> print(float(share.sel(input="body.dynamical_flattening").round(3)))
        1.0
        """
        answer, outputs = self.dataset, _members(self.dataset, "sensitivity")
        columns, count, needed = inputs_of(answer), answer.sizes[MEMBER], members_needed(answer)
        if count < needed:
            problem = f"{len(columns)} inputs need at least {needed} members"
            raise SceneError("sensitivity", f"{count} members", problem)
        classes = [array for array in columns.values() if array.dtype.kind == "U"]
        numbers = [array for array in columns.values() if array.dtype.kind != "U"]
        inputs = np.stack(numbers, axis=1) if numbers else np.empty((count, 0))
        no_slope = {"no_slope": "inputs that are names have no slope"} if classes else {}
        variables: dict[str, Any] = {}
        for name in (name for name in outputs if "_error" not in name):
            array = outputs[name]
            shares = sampling.shares_of_variance(inputs, array.values.astype(float), classes)
            what, rest = array.attrs.get("long_name", name), array.dims[1:]
            slope_units = f"{array.attrs.get('units', '1')} per unit of the input"
            along = ("input", *rest)
            for ending, values, dims, meaning, units in (
                ("slope", shares.slope, along, "change per unit of the input", slope_units),
                ("share", shares.share, along, "share of the variance", "1"),
                ("share_error", shares.error, along, _SHARE_ERROR, "1"),
                ("unexplained", shares.unexplained, rest, "variance not explained by the fit", "1"),
            ):
                attrs = {"long_name": f"{meaning}, of the {what}", "units": units}
                attrs |= no_slope if ending == "slope" else {}
                variables[f"{name}_{ending}"] = (dims, values, attrs)
        labels = {"input": ("input", [*columns], {"long_name": "input of the members"})}
        return xr.Dataset(variables, labels | _other_labels(answer), dict(answer.attrs))


def _without_inherited(node: xr.DataTree) -> xr.Dataset:
    """Return the Dataset of a tree node, without dimensions inherited from the root of the tree."""
    data = node.to_dataset()
    return data.drop_dims(data.sizes.keys() - node.to_dataset(inherit=False).sizes.keys())


def _spread(dataset: xr.Dataset) -> tuple[xr.Dataset, dict[str, str]]:
    """Split variables of a Dataset until all have the same dimensions, as table columns need.

    A variable with further dimensions becomes one variable for each of their labels. The dict has
    the names of the original variables.
    """
    columns: dict[str, xr.DataArray] = {}
    owners: dict[str, str] = {}
    dataset = texts_as_columns(dataset)
    dims = [frozenset(array.dims) for array in dataset.data_vars.values() if array.ndim]
    common = Counter(some.difference(("component", "quaternion", "axis")) for some in dims)
    rows = common.most_common(1)[0][0] if common else frozenset()
    for name, array in dataset.data_vars.items():
        along = [str(dim) for dim in array.dims if dim not in rows]
        for at in places(array, along):
            labels = (str(array[dim].values[number]) for dim, number in at.items())
            column = "_".join([str(name), *labels])
            columns[column], owners[column] = array.isel(at, drop=True), str(name)
    return xr.Dataset(columns), owners


# --- members of an ensemble -----------------------------------------------------------------------


def is_ensemble(answer: xr.Dataset | xr.DataTree) -> bool:
    """Return True if a result is an ensemble, that is, has the dimension `member`."""
    return MEMBER in answer.dims and any("input" in c.attrs for c in answer.coords.values())


def inputs_of(answer: xr.Dataset) -> dict[str, NDArray[Any]]:
    """Input values of all ensemble members, by input name: numerical inputs first, then texts.

    An input of several numbers has one entry for each number.
    """
    inputs = [array for array in answer.coords.values() if "input" in array.attrs]
    numbers = {
        f"{array.attrs['input']}{'' if array.ndim == 1 else f'.{k}'}": column
        for array in inputs
        if array.dtype.kind in "fiu"
        for k, column in enumerate(array.values.reshape(array.sizes[MEMBER], -1).T)
    }
    texts = {str(array.attrs["input"]): array for array in inputs if array.dtype.kind not in "fiu"}
    return numbers | {name: array.values.astype(str) for name, array in texts.items()}


def members_needed(answer: xr.Dataset) -> int:
    """Smallest number of ensemble members from which `sensitivity` can be computed.

    It is 2, plus 1 for each input that is a number, plus k - 1 for each input with k names.
    """
    columns = inputs_of(answer).values()
    classes = [len(np.unique(column)) for column in columns if column.dtype.kind == "U"]
    return 2 + len(columns) + sum(classes) - 2 * len(classes)


def _members(answer: xr.Dataset, what: str) -> dict[str, xr.DataArray]:
    """Numerical variables of an ensemble that depend on `member`, their first dimension."""
    if not is_ensemble(answer):
        problem = "it is not an ensemble; earthspin.ensemble makes one"
        raise SceneError(what, answer.attrs.get("title", "a Dataset"), problem)
    return {
        str(name): array.transpose(MEMBER, ...)
        for name, array in answer.data_vars.items()
        if MEMBER in array.dims and array.dtype.kind in "fiu"
    }


def _other_labels(answer: xr.Dataset) -> dict[Any, Any]:
    return {name: array for name, array in answer.coords.items() if MEMBER not in array.dims}
