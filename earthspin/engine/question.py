"""Base classes of questions (computations with inputs), and of functions that compute answers.

A question is a class that declares the inputs (keys) of a computation, with their types. The fields
define the keys of a scene file, the names that ``--set`` takes, the signature and docstring of the
public call, completion in the shell, and the page of keys.

A part is a typed function that computes one piece of an answer. The inputs of a part follow from
its signature: each parameter is a key of the question or the result of another part, by name. A
parameter whose default is None is optional. A part with only optional parameters needs at least one
of them.
"""

from __future__ import annotations

import inspect
import textwrap
import typing
from collections import OrderedDict
from collections.abc import Callable, Collection, Hashable, Iterable, Mapping
from dataclasses import MISSING, dataclass, field, fields
from functools import cache, cached_property, partial, update_wrapper
from threading import Lock
from typing import Any, ClassVar, Generic, NamedTuple, ParamSpec, Self, TypeVar, overload

from earthspin.engine.members import Members
from earthspin.engine.variables import Neglected, Variable, Variables
from earthspin.errors import EarthspinError, SceneError, Where, nearest
from earthspin.html_table import card
from earthspin.units import Kind, kind_of

#: Word that requests all sections that apply, or all columns.
ALL = "all"
#: Attribute of an answer that holds the complete question as the text of a scene file.
SCENE = "scene"
#: Keys of earlier versions, each with what to give instead. Stored scenes are read without them.
REMOVED = dict.fromkeys(
    ("uncertainty", "n"),
    "for errors from a sample, give members: "
    "earthspin.ensemble('precession', 1000).earthspin.quantiles()",
)


def hint(name: str, allowed: Iterable[str]) -> str:
    """Say what to give instead of a key that a question does not have."""
    return REMOVED.get(name) or nearest(name, allowed)


def key(default: Any = MISSING, *, doc: str) -> Any:
    """Declare an input (key) that users write at the top level of a scene file.

    Parameters
    ----------
    default
        Default as a user would write it; a key without a default is required.
    doc : str
        Meaning of the key, in one sentence.
    """
    return field(default=default, metadata={"doc": doc, "setting": False})


def setting(default: Any = MISSING, *, doc: str) -> Any:
    """Declare an input (key) that users write in the question's own table of a scene file."""
    return field(default=default, metadata={"doc": doc, "setting": True})


@dataclass(frozen=True)
class Key:
    """One key (input parameter) of a question: name, type, meaning and default.

    Attributes
    ----------
    name : str
    kind : Kind
    shown : object
        Default as a user would write it; MISSING if the key is required.
    doc : str
    setting : bool
        Whether the key belongs in the question's own table.
    """

    name: str
    kind: Kind[Any]
    shown: Any
    doc: str
    setting: bool

    @property
    def required(self) -> bool:
        """Return True if the user must give a value for this key, which has no default."""
        return self.shown is MISSING

    @cached_property
    def default(self) -> Any:
        """Default value of this key (input), converted to the type of the key."""
        return None if self.shown is None else self.kind.read(self.shown, Where(self.name))

    @property
    def default_words(self) -> str:
        """Default value of the key as text; empty if there is none."""
        if self.required or self.shown in (None, ""):
            return ""
        number = isinstance(self.shown, float)
        return plain_words(self.kind.write(self.shown) if number else self.shown)


def _read(kind: Kind[Any], value: object, where: Where) -> Any:
    """Convert a user's value to the type of a key; turn any failure into an `EarthspinError`.

    The value may be any object. Errors from libraries or from its own class would not help a user.
    """
    try:
        return kind.read(value, where)
    except EarthspinError:
        raise
    except Exception as error:
        raise where.error(value, f"it is not {kind.words}") from error


def _from_default(value: object, default: Any) -> object:
    """Add `from`, the default body, to a table of properties, unless it names another body."""
    name = getattr(default, "name", None)
    if name and isinstance(value, Mapping) and str(value.get("name", name)).lower() == name:
        return {"from": name, **value}
    return value


def _shown(value: Any, kind: Kind[Any]) -> Any:
    """Convert a value to the form that a user would write: bodies are replaced by their names."""
    bodies = value if isinstance(value, tuple) else (value,)
    return plain_words(value) if hasattr(bodies[0], "reference") else kind.write(value)


def names_in(value: str | Iterable[str], key: str) -> list[str]:
    """Convert one name, or several names, to a list; refuse anything that is not text.

    Raises
    ------
    SceneError
        If a name is not a text; `key` is the name of the argument, for the message.
    """
    try:
        names = [value] if isinstance(value, str) else [*value]
    except Exception:  # not iterable
        raise SceneError(key, value, f"give names, or '{ALL}'") from None
    for name in names:
        if not isinstance(name, str):
            raise SceneError(key, name, f"give names, or '{ALL}'")
    return names


def plain_words(value: Any) -> str:
    """Convert a value to text on one line; bodies are replaced by their names."""
    if isinstance(value, (tuple, list)):
        return ", ".join(plain_words(item) for item in value)
    return str(getattr(value, "name", value))


class Question:
    """Base class of questions (types of computation); the fields are inputs of all questions.

    Attributes
    ----------
    word : str
        Name of the question after ``compute =`` in a scene.
    call : str
        Name of the public function.
    table : str
        Name of the question's own table of settings in a scene; empty if it has none.
    page : str
        Page of the documentation that explains the method; empty if there is none.
    headline : str
        Variable of the answer, or error of several variables, that is quoted first.
    csv_columns : tuple of str
        Variables of the answer that a CSV file has by default, with their errors; all if empty.
    positional : tuple of str
        Positional arguments of the call.
    exclusive : tuple of tuple of tuple of str
        Choices between groups of keys, such as `times` or (`span`, `step`).
    by_body : tuple of str
        Keys whose defaults depend on the numbers of a body; all members of an ensemble have those
        of the nominal body.
    """

    word: ClassVar[str]
    call: ClassVar[str]
    table: ClassVar[str]
    page: ClassVar[str] = ""
    headline: ClassVar[str] = ""
    csv_columns: ClassVar[tuple[str, ...]] = ()
    positional: ClassVar[tuple[str, ...]]
    exclusive: ClassVar[tuple[tuple[tuple[str, ...], ...], ...]] = ()
    by_body: ClassVar[tuple[str, ...]] = ()
    graph: ClassVar[Graph]
    key_table: ClassVar[dict[str, Key]]

    title: str = key("", doc="title of tables and figures")
    members: Members | None = key(
        None,
        doc="run an ensemble: which inputs vary, and how; a whole number draws that many members "
        "from the published uncertainties of the bodies",
    )

    def __init_subclass__(
        cls, word: str = "", call: str = "", table: str = "", positional: tuple[str, ...] = ()
    ) -> None:
        """Store the names that a question class has in scene files and in Python.

        A subclass without `word` is no question itself: it holds keys for several questions.
        """
        cls.word, cls.call, cls.table = word, call, table
        cls.positional = positional or getattr(cls, "positional", ())
        dataclass(frozen=True, init=False, eq=False, repr=False)(cls)

    def __init__(self, **values: Any) -> None:
        self._fill(values, {})

    def _fill(
        self,
        values: Mapping[str, Any],
        known: Mapping[str, Any],
        source: str = "",
        in_scene: bool = False,
        typed: Collection[str] = (),
    ) -> Self:
        """Set all inputs of the question: convert values, refuse unknown names, check combinations.

        Values in `known` were read before and are not read again.
        """
        keys = keys_of(type(self))
        for name, value in values.items():
            if name not in keys:
                problem = f"compute = '{self.word}' has no such key: delete or rename it"
                problem += f"; {hint(name, keys)}"
                raise SceneError(name, value, problem, source=source)
        chosen = {name: value for name, value in values.items() if value is not None}
        object.__setattr__(self, "given", frozenset({*chosen, *known}))
        object.__setattr__(self, "read_from", source)
        for name, entry in keys.items():
            shown = f"{self.table}.{name}" if entry.setting and in_scene else name
            where = Where(shown, source, name in typed)
            if name in chosen:
                value = _read(entry.kind, _from_default(chosen[name], entry.shown), where)
            elif name in known:
                value = known[name]
            elif entry.shown is MISSING:
                raise where.error(None, f"required: {entry.doc} ({entry.kind.words})")
            else:
                value = entry.default
            object.__setattr__(self, name, value)
        object.__setattr__(self, "title", self.title or self.word)
        for groups in self.exclusive:
            used = [group for group in groups if self.given & set(group)]
            if len(used) > 1:
                ways = ", or ".join(" and ".join(group) for group in groups)
                raise self.error(used[0][0], "...", f"give either {ways}")
        self.check()
        return self

    def check(self) -> None:
        """Raise an error if values of inputs contradict each other; subclasses override this."""

    def where(self, name: str) -> Where:
        """Return the location of an input (name of the key, and scene file), for error messages."""
        return Where(name, self.read_from)

    def error(self, name: str, value: object, problem: str) -> SceneError:
        """Make the error for a wrong value of a key, without raising it."""
        return self.where(name).error(value, problem)

    #: Whether the answer includes the satellites of the body, or gives the size of their effect.
    with_satellites: ClassVar[bool] = False

    @property
    def unused(self) -> str:
        """Satellites of the body that the answer neglects, as text; empty if there are none."""
        satellites = getattr(getattr(self, "body", None), "satellites", ())
        names = ", ".join(satellite.name for satellite in satellites)
        return f"the satellites {names}" if names and not self.with_satellites else ""

    given: ClassVar[frozenset[str]]
    read_from: ClassVar[str]

    # --- as a scene ------------------------------------------------------------------------------

    @classmethod
    def from_table(
        cls,
        table: Mapping[str, Any],
        source: str = "",
        title: str = "",
        typed: Collection[str] = (),
    ) -> Self:
        """Make a question from the content of a scene file, a table without the key `compute`.

        Parameters
        ----------
        table : mapping
        source, title : str
        typed : collection of str
            Keys whose values were typed on the command line; their numbers need units.

        Raises
        ------
        SceneError, UnitsError
            If a key is unknown, missing or wrong.
        """
        values = ({"title": title} if title else {}) | cls.without_own_table(table, source)
        return cls.__new__(cls)._fill(values, {}, source, True, typed)

    @classmethod
    def without_own_table(cls, table: Mapping[str, Any], source: str = "") -> dict[str, Any]:
        """Return a scene, or changes of one, without the question's own table: all keys at the top.

        Users need not know which keys belong in the table.

        Raises
        ------
        SceneError
            If the table is none, or a key is given twice.
        """
        head = cls.table or cls.word.replace("-", "_")
        own = table.get(head, {})
        if not isinstance(own, Mapping):
            raise SceneError(head, own, f"it is a table: [{head}]", source=source)
        values: dict[str, Any] = {}
        others = ((str(name), value) for name, value in table.items() if name != head)
        for name, value in (*others, *own.items()):
            bare = name.removeprefix(f"{head}.")
            if bare in values:
                problem = f"it is given twice, with the table [{head}] and without"
                raise SceneError(bare, value, problem, source=source)
            values[bare] = value
        return values

    def to_table(self, *, given: bool = False) -> dict[str, Any]:
        """Convert the question to a table for a scene file, with the values of all keys.

        Parameters
        ----------
        given : bool
            Include only the keys that were given, without the defaults.
        """
        table: dict[str, Any] = {"compute": self.word}
        own: dict[str, Any] = {}
        keys = keys_of(type(self))
        without_effect = set[str]()
        for groups in self.exclusive:
            if used := [group for group in groups if self.given & set(group)]:
                without_effect |= set[str]().union(*groups).difference(*used)
        omitted = keys.keys() - self.given if given else without_effect
        for name, entry in keys.items():
            value = getattr(self, name)
            if value is not None and name not in omitted:
                (own if entry.setting else table)[name] = entry.kind.write(value)
        return table | ({self.table: own} if own else {})

    def keys(self) -> dict[str, Any]:
        """Return a dict of the values of all inputs (keys) of this question, by input name."""
        return {name: getattr(self, name) for name in keys_of(type(self))}

    def published_inputs(self) -> Mapping[str, tuple[str, tuple[float, float]]]:
        """Published probability distributions of numbers other than body properties, by input name.

        An entry is ``("normal", (mean, standard deviation))`` or ``("uniform", (low, high))``.
        The distributions of numbers of bodies follow from the bodies themselves.
        """
        return {}

    def replace(self, arrays: Mapping[str, Any] | None = None, /, **changes: Any) -> Self:
        """Return a copy of the question with some inputs changed; all checks are repeated.

        Parameters
        ----------
        arrays : mapping, optional
            Labelled arrays of member values, whose numbers were checked, for keys in `together` of
            `define_parts`.
        **changes
            Values of other keys, as a user writes them.
        """
        known = {name: getattr(self, name) for name in self.given if name not in changes}
        values, question = {"title": self.title} | changes, type(self).__new__(type(self))
        return question._fill(values, known | dict(arrays or {}), self.read_from)

    def _repr_html_(self) -> str:
        """HTML table of all inputs (keys): value, "given" or "default", and meaning."""
        rows = []
        for name, entry in keys_of(type(self)).items():
            value = getattr(self, name)
            if value is not None and name != "title":
                status = "given" if name in self.given else "default"
                rows.append((name, str(_shown(value, entry.kind)), status, entry.doc))
        return card(f"{self.title}: compute = {self.word}", rows)

    def __repr__(self) -> str:
        values = {n: v for n, v in self.keys().items() if n in self.given and v is not None}
        kinds = {name: entry.kind for name, entry in keys_of(type(self)).items()}
        shown = (f"{name}={_shown(value, kinds[name])!r}" for name, value in values.items())
        return f"{type(self).__name__}({', '.join(shown)})"


dataclass(frozen=True, init=False, eq=False, repr=False)(Question)


def keys_of(question: type[Question]) -> dict[str, Key]:
    """Return a dict of all inputs (`Key`) of a question class, by input name."""
    if "key_table" not in vars(question):
        hints = typing.get_type_hints(question, include_extras=True)
        shared = [entry.name for entry in fields(Question) if entry.name != "title"]  # type: ignore[arg-type]
        entries = sorted(fields(question), key=lambda entry: entry.name in shared)  # type: ignore[arg-type]
        question.key_table = {
            entry.name: Key(entry.name, kind_of(hints[entry.name]), entry.default, **entry.metadata)
            for entry in entries
        }
    return question.key_table


# --- text of a scene ------------------------------------------------------------------------------


def scene_text(question: Question) -> str:
    """Write a question, with the values of all its inputs, as the text of a scene file."""
    import tomli_w

    arrays: dict[str, str] = {}
    text = tomli_w.dumps(_shortened(question.to_table(), arrays))
    for mark, data in arrays.items():
        text = text.replace(f'float64 = "{mark}"', f'float64 = "{data}"', 1)
    return text


def _shortened(value: Any, arrays: dict[str, str]) -> Any:
    """Copy a table with placeholders instead of array data, and put these data into `arrays`."""
    if isinstance(value, list):
        return [_shortened(item, arrays) for item in value]
    if not isinstance(value, dict):
        return value
    if "float64" in value:
        mark = f"packed array {len(arrays):050}"
        arrays[mark] = value["float64"]
        return value | {"float64": mark}
    return {name: _shortened(item, arrays) for name, item in value.items()}


# --- parts ---------------------------------------------------------------------------------------

P = ParamSpec("P")
R = TypeVar("R", covariant=True)

#: Returns why a part is left out, from keys of the question; None if the part runs.
Reason = Callable[..., str | None]

#: Name of the parameter of a part that computes one block of a long series.
BLOCK = "block"
#: Number of results of a part that are stored for later calls.
STORED = 4


class Block(NamedTuple):
    """One block of a long series: the epochs with indices from `first` to `last` - 1."""

    first: int
    last: int


class Part(Generic[P, R]):
    """Function that computes one piece of a result, with a description of its inputs and outputs.

    Attributes
    ----------
    name : str
        Name of the function; other parts take the result as a parameter of this name.
    summary : str
        Description of the part: the first line of the docstring.
    needs, uses : tuple of str
        Names of the required and of the optional parameters.
    gives : mapping of str to Variable
        The variables that the part adds to an answer or section; empty for an intermediate part.
    fields : mapping of str to Variable
        Declarations of variables and labels.
    unless : tuple of callable
        Each takes keys of the question by name and returns a reason for leaving the part out.
    describe : callable or None
        Takes keys of the question by name and returns a description of the part.
    same_for : callable or None
        Takes the inputs of the part and returns a value; a result is reused if the value is equal.
    loads : tuple of str
        Modules that the function, or what it calls, imports when it runs, if this takes long.
    """

    def __init__(
        self,
        function: Callable[P, R],
        unless: Reason | tuple[Reason, ...] = (),
        describe: Callable[..., str] | None = None,
        same_for: Callable[..., Hashable] | None = None,
        loads: tuple[str, ...] = (),
    ) -> None:
        self.function, self.loads = function, loads
        self.unless = unless if isinstance(unless, tuple) else (unless,)
        self.describe, self.same_for = describe, same_for
        self._stored: OrderedDict[Hashable, R] = OrderedDict()
        self._lock = Lock()
        returned = _returned(function)
        self.gives, self.fields = returned.schema, returned.fields
        self.name = function.__name__
        line = (function.__doc__ or "").strip().split("\n")[0].rstrip(".")
        self.summary = line[:1].lower() + line[1:] if line[1:2].islower() else line
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Call the wrapped function."""
        return self.function(*args, **kwargs)

    def stored_or_computed(self, inputs: Mapping[str, Any]) -> tuple[R, bool]:
        """Return the result for given inputs, and whether an earlier result was reused."""
        key = None if self.same_for is None else self.same_for(**inputs)
        with self._lock:
            if key is not None and key in self._stored:
                return self._stored[key], True
        result = self.function(**inputs)  # type: ignore[call-arg]
        if key is not None:
            with self._lock:
                self._stored[key] = result
                if len(self._stored) > STORED:
                    self._stored.popitem(last=False)
        return result, False

    def __reduce__(self) -> str:
        # A module holds the part under the name of its function, so pickle stores only the name.
        return self.name

    def __repr__(self) -> str:
        return f"<part {self.title}: {self.summary}>"

    @property
    def title(self) -> str:
        """Name of this part (function) in the table of a plan."""
        return self.name.replace("_", "-")

    @cached_property
    def needs(self) -> tuple[str, ...]:
        """Names of the inputs that this part (function) requires: parameters without default."""
        return _parameters(self.function, inspect.Parameter.empty)

    @cached_property
    def uses(self) -> tuple[str, ...]:
        """Names of the optional inputs of this part (function): parameters with default None."""
        return _parameters(self.function, None)

    def reason(self, keys: dict[str, Any]) -> str | None:
        """Reason (text) why this function is left out for the inputs `keys`; None if it runs."""
        reasons = (condition(**_arguments(condition, keys)) for condition in self.unless)
        return next((why for why in reasons if why is not None), None)

    def description(self, keys: dict[str, Any]) -> str:
        """Describe what this part does for the given inputs, for the table of a plan."""
        describe = self.describe
        return self.summary if describe is None else describe(**_arguments(describe, keys))


@overload
def part(function: Callable[P, R], /) -> Part[P, R]: ...
@overload
def part(**options: Any) -> Callable[[Callable[P, R]], Part[P, R]]: ...
def part(function: Callable[P, R] | None = None, /, **options: Any) -> Any:
    """Turn a typed function into a `Part`, one step of a computation; a decorator.

    Parameters
    ----------
    function : callable
        Its parameters are names of keys of the question and of other parts.
    unless : callable or tuple of callable
        Functions of keys of the question that return a reason for leaving the part out, or None.
    describe : callable, optional
        Function of keys of the question that describes the part in a plan; the first line of the
        docstring by default.
    same_for : callable, optional
        Function of the inputs of the part. The result is stored, and reused in later runs for which
        the function returns an equal value; None means that the result is not stored.
    loads : tuple of str
        Modules that the function, or what it calls, imports when it runs, if this takes long. A run
        imports them before its first part, so that the run time of the part is that of its work.
    """
    return partial(Part, **options) if function is None else Part(function, **options)


def _arguments(function: Callable[..., Any], keys: dict[str, Any]) -> dict[str, Any]:
    """Select the inputs of a question that a function requires, as a dict by name."""
    return {name: keys[name] for name in _parameters(function, inspect.Parameter.empty)}


def _returned(function: Callable[..., Any]) -> type[Variables]:
    """`Variables` subclass in the return annotation of a function; without one, `Variables`."""
    returned = function.__annotations__.get("return")
    if isinstance(returned, str):
        returned = function.__globals__.get(returned)
    if isinstance(returned, type) and issubclass(returned, Variables):
        return returned
    return Variables


@cache
def _parameters(function: Callable[..., Any], default: object) -> tuple[str, ...]:
    parameters = inspect.signature(function).parameters.values()
    return tuple(entry.name for entry in parameters if entry.default is default)


# --- what a question is made of ------------------------------------------------------------------


@dataclass(frozen=True)
class Graph:
    """All functions (parts) of a computation, and which of them form the result and each section.

    Attributes
    ----------
    parts : dict of str to Part
        All parts by name.
    answer : tuple of str
        Names of the parts whose variables make up the answer.
    sections : dict of str to tuple of str
        Names of the parts whose variables make up each section.
    together : tuple of str
        Keys whose numbers may be labelled arrays in every part of the answer, so that members of
        an ensemble are computed together.
    widest : int
        Largest number of members that are computed together.
    """

    parts: dict[str, Part[..., Any]]
    answer: tuple[str, ...]
    sections: dict[str, tuple[str, ...]]
    together: tuple[str, ...] = ()
    widest: int = 1

    @cached_property
    def variables(self) -> dict[str, Variable]:
        """Declarations of all variables that the results of the question may have, by name."""
        return {name: v for part in self.parts.values() for name, v in part.gives.items()}

    @cached_property
    def ends(self) -> tuple[str, ...]:
        """Names of the parts that every answer needs, with that of the neglected effects."""
        return (*self.answer, Neglected.PART)

    @cached_property
    def labels(self) -> set[str]:
        """Names of all variables and dimensions that the results of the question may have."""
        dims = {name for variable in self.variables.values() for name in variable.dims}
        return {*dims, *self.variables}.union(*(part.fields for part in self.parts.values()))

    @cached_property
    def constant_labels(self) -> dict[str, list[str]]:
        """Labels that are always the same, in their order, by dimension."""
        fields = (field for part in self.parts.values() for field in part.fields.items())
        return {name: entry.default for name, entry in fields if isinstance(entry.default, list)}


Parts = Part[..., Any] | tuple[Part[..., Any], ...]


def define_parts(
    question: type[Question],
    *,
    answer: Parts,
    sections: Iterable[Parts] | Mapping[str, Parts],
    parts: Iterable[Part[..., Any]] = (),
    together: tuple[str, ...] = (),
    widest: int = 1,
) -> None:
    """Define the functions (parts) that answer a question, and check their names and parameters.

    Parameters
    ----------
    question : type
    answer : Part or tuple of Part
        Parts whose variables a call returns; the first must run.
    sections : iterable or mapping of Part or tuple of Part
        Parts of further results; a section has the name of its first part, or that in the mapping.
        `neglected` is required.
    parts : iterable of Part
        Intermediate parts.
    together : tuple of str
        Keys whose numbers may be labelled arrays in every part of the answer.
    widest : int
        Largest number of members of an ensemble that are computed together.

    Raises
    ------
    TypeError
        If a parameter of a part is neither a key nor a part, a key and a part share a name, or the
        part `neglected` is missing.
    """
    if not isinstance(sections, Mapping):
        sections = {
            (group if isinstance(group, Part) else group[0]).name: group for group in sections
        }
    groups = {
        name: group if isinstance(group, tuple) else (group,)
        for name, group in {"answer": answer, **sections}.items()
    }
    all_parts = [*parts, *(part for group in groups.values() for part in group)]
    named = {part.name: part for part in all_parts}
    names, keys = set(named), set(keys_of(question))
    if len({id(part) for part in all_parts}) != len(named) or names & keys:
        raise TypeError(f"{question.__name__}: two parts, or a part and a key, share a name")
    for part in all_parts:
        for parameter in (*part.needs, *part.uses):
            if parameter not in names | keys | {BLOCK}:
                problem = f"takes '{parameter}', which is neither a key nor a part; add it"
                raise TypeError(f"{question.__name__}: {part.name} {problem}")
    if Neglected.PART not in names:
        raise TypeError(f"{question.__name__} has no part '{Neglected.PART}'")
    ends = {name: tuple(part.name for part in group) for name, group in groups.items()}
    question.graph = Graph(named, ends.pop("answer"), ends, together, widest)


# --- words for people ----------------------------------------------------------------------------


def describe_keys(question: type[Question]) -> str:
    """Describe all keys (inputs) of a question as text: allowed values, meaning, default."""
    lines: list[str] = []
    heading = ["", f"[{question.table}]"]
    for entry in sorted(keys_of(question).values(), key=lambda entry: entry.setting):
        if entry.setting:
            lines, heading = lines + heading, []
        default = f" (default: {entry.default_words})" if entry.default_words else ""
        default = " (must be given)" if entry.required else default
        meaning = textwrap.fill(f"{entry.doc}{default}", 88)
        lines += [f"{entry.name}: {entry.kind.words}", textwrap.indent(meaning, "    ")]
    return "\n".join(lines)
