"""Read and run scenes: tables of inputs for one computation (question) or for an ensemble."""

from __future__ import annotations

import os
import re
import tomllib
import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from importlib import import_module, resources
from pathlib import Path
from typing import Any, Literal

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import Body, in_a_sentence
from earthspin.bodies.body import members
from earthspin.engine import blocks, public_calls
from earthspin.engine.atomic_writes import as_path
from earthspin.engine.ensemble import Ensemble
from earthspin.engine.members import ENDLESS, LARGEST_SEED, MOST_PARTS, TWICE, Members
from earthspin.engine.origin import difference, scene_of
from earthspin.engine.question import BLOCK as BY_BLOCK
from earthspin.engine.question import REMOVED, Question, keys_of
from earthspin.engine.run import Plan, Run
from earthspin.engine.store import open as open_file
from earthspin.errors import OutputError, SceneError, Where, nearest, no_plain_file
from earthspin.plug_ins import plug_in
from earthspin.questions import MODULES, time_axes
from earthspin.units import FileName, Whole, is_whole


class _Questions(Mapping[str, type[Question]]):
    """Mapping from names of computations (questions), as in scene files, to `Question` classes.

    A module is named after the word of its question, and imported when the class is needed. Another
    package offers a question by an entry point, which is loaded when a name is not known.
    """

    @property
    def calls(self) -> dict[str, str]:
        """Names of the public functions, by the name of each computation in scene files."""
        modules = MODULES.items()
        return {path.rpartition(".")[2].replace("_", "-"): call for call, path in modules}

    def __getitem__(self, word: str) -> type[Question]:
        if call := self.calls.get(word):
            return getattr(import_module(MODULES[call]), call).question  # type: ignore[no-any-return]
        if offered := plug_in("questions", word):
            return offered.question  # type: ignore[no-any-return]
        raise KeyError(word)

    def __iter__(self) -> Iterator[str]:
        return iter(self.calls)

    def __len__(self) -> int:
        return len(self.calls)


QUESTIONS = _Questions()

_DEEP_KEY = re.compile(rf"""(?<![\w"'-])(?:[\w"'-]+[ \t]*\.[ \t]*){{{MOST_PARTS}}}""")

#: How many times a long series is written at once.
BLOCK = 1 << 17


class VersionWarning(UserWarning):
    """Warning that a stored result is computed again with other versions of libraries or files.

    Examples
    --------
    A result of another version is computed again, with this warning:

    >>> import warnings
    >>> import earthspin
    >>> old = earthspin.precession(perturbers="sun").assign_attrs(earthspin_version="0.0")
    >>> with warnings.catch_warnings(record=True) as said:
    ...     warnings.simplefilter("always")
    ...     _ = earthspin.run(old)
    >>> print(said[0].category.__name__)
    VersionWarning
    """


def Scene(*, compute: str, **keys: Any) -> Question:
    """Create a question (a computation with all its inputs) from keys and values of a scene.

    Parameters
    ----------
    compute : str
        Name of the question: ``"precession"``, ``"torque"``, ...
    **keys
        Keys of that question, as in a scene file or as arguments of its call.

    Raises
    ------
    SceneError, UnitsError, BodyError
        If a key is unknown, missing or wrong.

    Examples
    --------
    >>> import earthspin
    >>> question = earthspin.Scene(compute="precession", perturbers="sun")
    >>> print(earthspin.run(question).precession_period.sel(perturber="sun").round(1).values)
    81259.1
    """
    return question_named(compute).from_table(keys)


def question_named(word: object, source: str = "") -> type[Question]:
    """Return the `Question` class (type of computation) that scene files call by a given name.

    Raises
    ------
    SceneError
        If there is none; it names the nearest.
    """
    if not isinstance(word, str) or word not in QUESTIONS:
        raise SceneError("compute", word, nearest(word, QUESTIONS), source=source)
    return QUESTIONS[word]


def load_scene(scene: Any, changes: Mapping[str, Any] | None = None) -> Question:
    """Read a question (a computation with inputs) from a scene or a result, with optional changes.

    Parameters
    ----------
    scene : str, Path, Question, Dataset or DataTree
        ``"precession"``, the path of a TOML file, the path of a file that earthspin wrote, or an
        answer.
    changes : mapping, optional
        Keys to set instead of those of the scene; ``"body.j2"`` sets a value inside a table. Keys
        that exclude others replace them: ``"times"`` replaces ``"span"`` and ``"step"``. Plain
        numbers are in SI units here; those in a scene file carry their units.

    Raises
    ------
    SceneError
        If there is no such scene, it is not TOML, a key is unknown or wrong, or an answer names a
        file of another kind than its key takes.

    Examples
    --------
    >>> import earthspin
    >>> question = earthspin.load_scene("precession", {"perturbers": "sun"})
    >>> print(question)
    Precession(title='Precession of the equinoxes', perturbers='sun')
    """
    return _load(scene, changes, typed=False)


def typed_scene(scene: str, changes: Mapping[str, Any]) -> Question:
    """Read a question from a scene, and change inputs; numbers in the changes must have units.

    Parameters
    ----------
    scene : str
    changes : mapping
        Their numbers carry units where they have a dimension.
    """
    return _load(scene, changes, typed=True)


def _load(scene: Any, changes: Mapping[str, Any] | None, *, typed: bool) -> Question:
    """Read a question from a scene, file or result, and set new values of some inputs.

    If `typed`, numbers in the changes have units, otherwise they are in SI units.
    """
    stored = True  # written with an answer: its plain numbers are in SI units
    if changes is not None and not isinstance(changes, Mapping):
        raise SceneError("changes", changes, "give a mapping of keys to values")
    changes = changes or {}
    if isinstance(scene, Question):
        if not changes:
            return scene
        table = scene.to_table(given=True) | {"title": scene.title}
        return _changed(table, changes, "", "", set())
    if hasattr(scene, "attrs"):
        text, source, title = _scene_of(scene), "", ""
    elif not isinstance(scene, (str, os.PathLike)):
        raise SceneError("scene", scene, "give a name, a path, a question or an answer")
    elif Path(str(scene)).suffix in (".nc", ".zarr"):
        answer = open_file(Path(scene))
        text, source, title = _scene_of(answer), str(scene), ""
    else:
        text, source, title = _read(os.fspath(scene))
        stored = False
    named = "file" if source else "scene"
    try:
        table = toml(text)
    except tomllib.TOMLDecodeError as error:
        raise SceneError(named, source, f"it is not TOML: {error}") from None
    except (ValueError, RecursionError) as error:
        raise SceneError(named, source, f"it cannot be read: {error}") from None
    if stored:
        table = {name: value for name, value in table.items() if name not in REMOVED}
    own_body = table.get("body", "earth")
    with_units = set() if stored else _names(table)
    changed = _names(changes) | {part for key in changes for part in str(key).split(".")[:2]}
    with_units = with_units | changed if typed else with_units - changed
    if stored and isinstance(table.get("members"), str):
        problem = "a stored scene holds its members, not the path of a file"
        raise SceneError("members", table["members"], problem, source=source)
    question = _changed(table, changes, source, title, with_units)
    for key, path, kind in files_of(question, changes) if stored else ():
        _check_kind(key, path, kind, source)
    body = getattr(question, "body", None) if source.startswith("scene '") else None
    if isinstance(body, Body) and body.name != own_body and "title" not in changes:
        # the titles of shipped scenes name their own body
        name = in_a_sentence(body.name)
        renamed = re.sub("(?i)the equinoxes|the earth|the moon", lambda _: name, question.title)
        return question.replace(title=renamed[:1].upper() + renamed[1:])
    return question


def _names(table: Mapping[str, Any]) -> set[str]:
    """Names of all keys in a scene, both at the top level and inside tables."""
    return {*table}.union(*(inner for inner in table.values() if isinstance(inner, Mapping)))


def _changed(
    table: dict[str, Any], changes: Mapping[str, Any], source: str, title: str, typed: set[str]
) -> Question:
    """Build a question from the table of inputs of a scene, with new values for some keys."""
    word = changes.get("compute", table.get("compute"))
    if word is None:
        raise SceneError("compute", None, f"it is missing; {nearest('', QUESTIONS)}", source=source)
    question, set_before = question_named(word, source), list[str]()
    table, changes = (question.without_own_table(keys, source) for keys in (table, changes))
    for key, value in changes.items():
        leaves = [*_leaves(str(key), value)]
        for before in set_before:
            if before in leaves or before.startswith(f"{key}."):
                raise SceneError(before, value, f"{TWICE}, and tables first", source=source)
        set_before += leaves
        _set_key(table, str(key), value, source)
    del table["compute"]
    for groups in question.exclusive:  # `times` replace the scene's `span` and `step`
        for group in groups:
            if not changes.keys().isdisjoint(group):
                others = {key for other in groups if other != group for key in other}
                table = {key: table[key] for key in table if key not in others - changes.keys()}
    return question.from_table(table, source=source, title=title, typed=typed)


def _leaves(key: str, value: Any) -> Iterator[str]:
    """Yield the dotted names of all values in a nested table; yield `key` for any other value."""
    if not isinstance(value, Mapping):
        yield key
        return
    if key.count(".") >= MOST_PARTS:
        raise SceneError("changes", "a table", ENDLESS)
    for name, inner in value.items():
        yield from _leaves(f"{key}.{name}", inner)


def shipped_scenes() -> dict[str, str]:
    """Names and titles of the scenes that are part of the package."""
    folder = resources.files("earthspin") / "shipped"
    titles = {}
    for file in sorted(folder.iterdir(), key=lambda f: f.name.removesuffix(".toml")):
        if file.name.endswith(".toml"):
            table = tomllib.loads(file.read_text(encoding="utf-8"))
            titles[file.name.removesuffix(".toml")] = table.get("title", "")
    return titles


def plan(scene: Any, sections: str | Iterable[str] = ()) -> Plan:
    """Plan the run of a scene: which computations will run and which are left out, with reasons.

    Parameters
    ----------
    scene : str, Path, Question, Dataset or DataTree
        See `load_scene`.
    sections : str or iterable of str
        Sections that are wanted beside the answer; ``"all"`` takes all that apply.

    Raises
    ------
    SceneError
        If nothing that answers the question can run; it gives the reason.

    Examples
    --------
    >>> import earthspin
    >>> chosen = earthspin.plan("sun-only")
    >>> print(chosen.parts[-2].title)
    precession-rates
    >>> print(chosen.left_out["seasons"])
    the moon is not among the perturbers
    """
    return Run(load_scene(scene)).plan(sections)


def run(scene: Any) -> xr.Dataset:
    """Run the computation of a scene or a question, and return the result as a Dataset.

    Parameters
    ----------
    scene : str, Path, Question, Dataset or DataTree
        The name of a shipped scene, a file, a question, or an answer that is run again: with the
        same versions and processor instructions, the result is bit-identical; if versions differ, a
        warning names them.

    Returns
    -------
    Dataset
        The answer; `ds.earthspin` gives its plan and its complete question.

    Raises
    ------
    OutputError
        If the file cannot be read.
    EarthspinError
        If the scene has a wrong key or value, or the question cannot be answered.

    Examples
    --------
    >>> import earthspin
    >>> answer = earthspin.run("sun-only")
    >>> print(answer.precession_period.sel(perturber="sun").round(1).values)
    81259.1
    >>> print(earthspin.run(answer).identical(answer))
    True
    """
    answer = public_calls.answer(load_scene(scene))
    warn_of_versions(_attributes(scene), answer)
    return answer


def run_tree(scene: Any, sections: str | Iterable[str] = "all") -> xr.DataTree:
    """Run a scene or a question; return the result, its sections and the plan as a DataTree.

    Parameters
    ----------
    scene : str, Path, Question, Dataset or DataTree
        See `run`.
    sections : str or iterable of str
        Names of sections, or ``"all"``.

    Returns
    -------
    DataTree
        The answer at the root, a node for each section, and the node ``plan``.

    Raises
    ------
    EarthspinError
        If the question lacks a section, or for the reasons of `run`.

    Examples
    --------
    >>> import earthspin
    >>> tree = earthspin.run_tree("precession", sections="seasons")
    >>> print(list(tree.children))
    ['seasons', 'plan']
    >>> print(tree["seasons"].time_per_degree.round(2).values)
    71.59
    """
    tree = public_calls.answer_tree(load_scene(scene), sections)
    warn_of_versions(_attributes(scene), tree)
    return tree


def _attributes(scene: Any) -> Mapping[str, Any]:
    """Attributes of a result or of a result file; empty for any other scene."""
    if isinstance(scene, (str, Path)) and Path(str(scene)).suffix in (".nc", ".zarr"):
        scene = open_file(scene)
    return getattr(scene, "attrs", {})


def versions_of(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """Select the versions and checksums of files among the attributes of a result.

    `sampled` is of earlier versions, whose answers had errors from a sample on request.
    """
    endings = ("_version", "ephemeris_sha256", "orbit_sha256", "table_sha256", "sampled")
    return {name: value for name, value in attributes.items() if str(name).endswith(endings)}


def warn_of_versions(
    old: Mapping[str, Any], new: xr.Dataset | xr.DataTree, stacklevel: int = 3
) -> None:
    """Warn if a stored result was computed with other versions than the new result.

    Parameters
    ----------
    old : mapping
        Attributes of the stored result.
    new : Dataset or DataTree
    stacklevel : int
        See `warnings.warn`.
    """
    changed = {n: was for n, was in versions_of(old).items() if was != new.attrs.get(n)}
    if changed:
        words = "; ".join(f"{n} {was}, now {new.attrs.get(n)}" for n, was in changed.items())
        warnings.warn(f"made with {words}", VersionWarning, stacklevel=stacklevel)


# --- long series ---------------------------------------------------------------------------------


def write_series(scene: Any, path: str | Path, *, client: object = None) -> Path:
    """Compute a time series of torques, pole or rotation, and write it to Zarr block by block.

    Parameters
    ----------
    scene : str, Path, Question or answer
        Scene that computes ``torque``, ``pole`` or ``rotation``.
    path : str or Path
        The Zarr folder; an existing folder is replaced when the series is complete. After an
        interruption the same call resumes it.
    client : Client, int or str, optional
        Cluster of ``dask.distributed`` that computes the blocks: a client, a number of workers to
        start here, or the address of a scheduler. Without it the blocks are computed here.

    Returns
    -------
    Path

    Raises
    ------
    EarthspinError
        If the target cannot be written, or the answer has no blocks; or for the reasons of `run`.

    Examples
    --------
    >>> import earthspin
    >>> decade = {"span": ["2000-01-01", "2010-01-01"], "step": "1 h"}
    >>> scene = earthspin.load_scene("torque", decade)
    >>> path = earthspin.write_series(scene, "decade.zarr")
    >>> print(earthspin.open(path).sizes["time"])
    87673
    """
    return blocks.write(_series(load_scene(scene)), path, client=client, replace=True)


def _series(question: Question) -> blocks.BlockSeries:
    """Prepare to compute a long series of torques, pole or rotation in blocks, as `BlockSeries`.

    Refuse all other questions.
    """
    size = series_length(question)
    if size == 0:
        problem = "only a series of torques, pole or rotation is written by region"
        raise SceneError("compute", question.word, problem)
    if question.members is not None:
        raise question.error("members", "...", "give the scene and the path to earthspin.ensemble")
    return blocks.BlockSeries(question, size, max(1, BLOCK // members_of(question)))


def series_length(question: Question) -> int:
    """Number of times in the time series that a question computes.

    It is 0 if the result cannot be written in blocks.
    """
    if not any(BY_BLOCK in part.uses for part in question.graph.parts.values()):
        return 0

    keys = question.keys()
    return time_axes.epochs(keys["span"], keys["step"], keys["times"]).size


def members_of(question: Question) -> int:
    """Number of bodies in a question; more than 1 only if body fields are labelled arrays."""
    groups = [value if isinstance(value, tuple) else (value,) for value in question.keys().values()]
    return members(value for group in groups for value in group if isinstance(value, Body))


# --- ensembles -----------------------------------------------------------------------------------


def ensemble(
    question: Any,
    members: Any = None,
    *,
    seed: int | None = None,
    rng: int | np.random.Generator | np.random.SeedSequence | None = None,
    path: str | Path | None = None,
    client: object = None,
    block: int | None = None,
    impossible: Literal["refuse", "drop"] | None = None,
) -> xr.Dataset:
    """Answer one question (computation) for many sets of inputs, the members of an ensemble.

    The random numbers of a member depend only on the seed and on the number of the member, not on
    blocks or workers.

    Parameters
    ----------
    question : str, Path, Question or answer
        See `load_scene`.
    members : int, mapping, Dataset or path, optional
        A number of members: they are drawn from the published uncertainties of the bodies, or as
        the table ``members`` of the question says. A mapping of inputs to distributions:
        ``{"n": 1000, "body.j2": {"normal": [1.0826e-3, 1e-10]}}``, with ``normal``, ``uniform``,
        ``choice`` and ``grid``; the last two also take words, such as the paths of orbits:
        ``{"orbit": {"grid": ["own", "la2010a.dat"]}}``. Or values: a Dataset of variables along
        `member`, named after the inputs, or the path of a file (.csv, .nc, .zarr) with one.
    seed : int, optional
        Seed of the random numbers; 0 by default.
    rng : int, Generator or SeedSequence, optional
        Instead of `seed`: a seed, or a source of random numbers of NumPy, from which a seed is
        drawn (SPEC 7).
    path : str or Path, optional
        Zarr store to write, block by block; after an interruption the same call resumes it.
    client : Client, int or str, optional
        Cluster of ``dask.distributed`` that computes the blocks: a client, a number of workers to
        start here, or the address of a scheduler. Without it the blocks are computed here.
    block : int, optional
        Number of members that are computed and stored at a time; chosen by their size by default.
    impossible : str, optional
        Treatment of impossible members: ``"refuse"`` the ensemble, or ``"drop"`` them.

    Returns
    -------
    Dataset
        Answer along `member`, with the inputs as coordinates; variables that depend on no input
        have no dimension `member`. ``ds.earthspin.quantiles()`` and
        ``ds.earthspin.sensitivity()`` summarise it. With `path` it is opened from the store.

    Raises
    ------
    EarthspinError
        If an input is wrong or a member is not possible; the message is one line.

    Examples
    --------
    >>> import earthspin
    >>> earths = earthspin.ensemble("precession", 1000)
    >>> total = earths.precession_period.sel(perturber="total")
    >>> print(f"{float(total.mean()):.1f} +/- {2 * float(total.std()):.3f} years")
    25712.1 +/- 0.016 years
    """
    loaded = load_scene(question)
    if rng is not None:
        if seed is not None:
            raise loaded.error("rng", rng, "give either seed or rng")
        seed = _seed_from(rng)
    request = _with_members(loaded, members, {"seed": seed, "impossible": impossible})
    if block is not None:
        block = Whole().read(block, request.where("block"))
    if path is not None and as_path(path).suffix != ".zarr":
        raise OutputError(path, "its name does not end in .zarr", "an ensemble goes to Zarr")
    work = Ensemble(request, block=block, in_memory=path is None)
    if path is None:
        return work.hold(client)
    answer = open_file(blocks.write(work, path, client=client))
    return answer.to_dataset() if isinstance(answer, xr.DataTree) else answer


def _with_members(question: Question, members: object, settings: dict[str, Any]) -> Question:
    """Return a question with another ensemble; an integer replaces only the number of members."""
    own, where = question.members, question.where("members")
    request: Members | None = own if members is None else Members.read(members, where)
    if request is None:
        raise where.error(None, "give the number of members, a file or a table")
    if own is not None and is_whole(members):
        request = replace(own, n=request.n)
    changes = {name: value for name, value in settings.items() if value is not None}
    checked = Members.read(changes, where)
    changes = {name: getattr(checked, name) for name in changes}
    return question.replace(members=replace(request, **changes))


def _seed_from(rng: int | np.random.Generator | np.random.SeedSequence) -> int:
    """Return a given integer seed, or draw one from a NumPy generator or seed sequence."""
    if isinstance(rng, (np.random.Generator, np.random.SeedSequence)):
        return int(np.random.default_rng(rng).integers(2**32))
    others = ", or a Generator or SeedSequence of NumPy"
    return Whole(0, LARGEST_SEED, others).read(rng, Where("rng"))


# --- reading -------------------------------------------------------------------------------------


def _scene_of(answer: Any) -> str:
    """Text of the scene from which a stored result was computed; refuse a result without one."""
    text = scene_of(answer)
    if not text:
        why = difference(answer) or "it has no scene"
        problem = f"{why}; give a whole answer, not a section, with its attributes"
        raise SceneError("scene", type(answer).__name__, problem)
    return text


def _read(scene: str | Path) -> tuple[str, str, str]:
    """Read a scene: return the text, the file or scene name for messages, and a default title."""
    text = str(scene)
    if "/" not in text and not text.endswith(".toml"):
        names = shipped_scenes()
        if text not in names:
            raise SceneError("scene", text, f"no such scene; {nearest(text, names)}, or a file")
        file = resources.files("earthspin") / "shipped" / f"{text}.toml"
        return file.read_text(encoding="utf-8"), f"scene '{text}'", text
    path = Path(scene)
    if problem := no_plain_file(path):
        raise SceneError("scene", text, f"it cannot be read: {problem}")
    try:
        return path.read_text(encoding="utf-8-sig"), text, path.stem
    except FileNotFoundError:
        problem = f"there is no such file; shipped: {', '.join(shipped_scenes())}"
        raise SceneError("scene", text, problem) from None
    except OSError as error:
        raise SceneError("scene", text, f"it cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise SceneError("scene", text, "it cannot be read: it is not text in UTF-8") from None


def toml(text: str) -> dict[str, Any]:
    """Parse a TOML text; refuse keys with more than `MOST_PARTS` parts between dots.

    Raises
    ------
    ValueError
        If it is none, or a key has more than `MOST_PARTS` parts, which would take minutes.
    """
    if _DEEP_KEY.search(text):
        raise ValueError(f"a key has more than {MOST_PARTS} parts between dots")
    return tomllib.loads(text)


def files_of(question: Question, without: Iterable[str] = ()) -> list[tuple[str, Path, FileName]]:
    """List the files that a question reads: name of the input, path, and expected type of file.

    Parameters
    ----------
    question : Question
    without : iterable of str
        Keys to leave out.
    """
    members, files = question.members, []
    for name, key in keys_of(type(question)).items():
        dotted = f"{question.table}.{name}" if key.setting else name
        kind = key.kind
        if not isinstance(kind, FileName) or dotted in without:
            continue
        values = [getattr(question, name)]
        if members is not None and name in members.distributions:
            values = [*members.distributions[name].numbers]
        elif members is not None and name in members.values:
            values = np.unique(members.values[name].values).tolist()
        files += [(dotted, Path(v).absolute(), kind) for v in values if kind.is_path(v)]
    return files


#: How many first bytes are looked at: more than any table has above its numbers.
_HEAD = 1 << 16


def _check_kind(key: str, path: Path, kind: FileName, source: str) -> None:
    """Raise an error if a file named in a stored scene is not of the type that the input requires.

    Raises
    ------
    SceneError
    """
    problem = no_plain_file(path)
    try:
        if not problem and path.exists():
            with path.open("rb") as file:
                problem = "" if kind.begins(file.read(_HEAD)) else f"it is not {kind.content}"
    except OSError as error:
        problem = f"it cannot be read: {error.strerror}"
    if problem:
        message = f"{problem}, so the file that the stored scene names is not read"
        raise SceneError(key, str(path), message, source=source)


def _set_key(table: dict[str, Any], key: str, value: Any, source: str) -> None:
    """Set the value of a key in the table of a scene; dots in the key lead to inner tables."""
    if key.count(".") >= MOST_PARTS:
        raise SceneError(key, value, f"give a key of at most {MOST_PARTS} parts", source=source)
    *path, last = key.split(".")
    for step in path:
        inner = table.get(step, {})
        # `body = "earth"` with body.j2 set means: start from that body.
        if step == "body" and isinstance(inner, str):
            inner = {"from": inner}
        table[step] = inner
        if not isinstance(inner, dict):
            raise SceneError(key, value, f"'{step}' is not a table", source=source)
        table = inner
    table[last] = value
