"""Only what a scene needs is loaded, shown in fresh processes."""

import json
from pathlib import Path

import pytest

from earthspin.scenes import shipped_scenes
from tests.processes import printed

#: What costs a second or more to load, and what stands on it.
HEAVY = {
    *("scipy", "astropy", "xarray", "pandas", "jplephem", "skyfield", "erfa", "matplotlib"),
    *("netCDF4", "zarr", "dask", "jinja2", "rich"),
}


def modules_after(program: str) -> set[str]:
    """Top-level modules that a fresh process has imported after a program."""
    listing = "\nimport sys; print(' '.join(sorted({m.split('.')[0] for m in sys.modules})))"
    return set(printed(program + listing).splitlines()[-1].split())


def test_importing_costs_nothing() -> None:
    assert not modules_after("import earthspin; dir(earthspin)") & {"numpy", *HEAVY}


def test_bodies_load_numpy_at_most() -> None:
    assert not modules_after("import earthspin; earthspin.EARTH; earthspin.Body") & HEAVY


def test_a_wobble_opens_no_sky() -> None:
    program = """
import builtins, io
opened = []
real = io.open
def watch(file, *args, **kwargs):
    opened.append(str(file))
    return real(file, *args, **kwargs)
builtins.open = io.open = watch
import earthspin
earthspin.run("wobble")
earthspin.wobble_ladder()
assert not any(name.endswith(".bsp") for name in opened)
"""
    assert not modules_after(program) & {"skyfield", "jplephem", "numba", "matplotlib", "erfa"}


@pytest.mark.parametrize("call", ["precession", "torque_series"])
def test_answers_of_numpy_arrays_load_no_other_array_library(call: str) -> None:
    """Where xarray would look for arrays of dask and pint, it imports both."""
    assert not modules_after(f"import earthspin; earthspin.{call}()") & {"dask", "pint"}


#: Commands, and what each alone of them needs.
COMMANDS = {
    "scenes": set(),
    "run wobble": set(),
    "run precession": {"jplephem", "skyfield"},
    "run torque --out torque.nc": {"jplephem", "netCDF4"},
}


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_load_only_what_they_use(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    program = f"""
import sys
from earthspin.cli import main
sys.argv = ["earthspin", *{command.split()}]
assert main() == 0
for name in [name for name, module in sys.modules.items() if module is None]:
    del sys.modules[name]
"""
    some = {"jplephem", "skyfield", "matplotlib", "netCDF4", "zarr", "dask", "distributed", "pint"}
    assert modules_after(program) & some == COMMANDS[command]


def test_the_observed_pole_needs_no_kernel() -> None:
    loaded = modules_after("import earthspin; earthspin.run('polar-motion')")
    assert not loaded & {"skyfield", "jplephem", "numba", "matplotlib", "erfa", "rich"}


#: What costs a tenth of a second or more, or belongs to drawing, files and workers.
WATCHED = {
    *("scipy.fft", "scipy.integrate", "scipy.interpolate", "scipy.linalg", "scipy.optimize"),
    *("scipy.signal", "scipy.sparse", "scipy.spatial", "scipy.special", "scipy.stats"),
    *("astropy", "skyfield", "jplephem", "erfa", "matplotlib", "netCDF4", "zarr", "distributed"),
    *("numba", "jinja2", "rich"),
}


#: Runs each program in a child of one process that holds what all answers import, and prints for
#: each the modules that it has imported.
CHILDREN = """
import json, os, sys
sys.modules["dask"] = None  # xarray loads dask where it is installed: here as if it were not
import numpy, xarray, earthspin
for program in json.load(sys.stdin):
    if os.fork() == 0:
        exec(program)
        print(" ".join(sys.modules), flush=True)
        os._exit(0)
    assert os.wait()[1] == 0, program
"""


def watched_after(programs: list[str]) -> list[set[str]]:
    """Watched modules that a process has imported after each of some programs, run alone."""
    out = printed(CHILDREN, input=json.dumps(programs))
    return [set(line.split()) & WATCHED for line in out.splitlines()]


#: Runs a scene, and leaves in `sys.modules` only what was imported while a part ran.
DURING_PARTS = """
from earthspin.engine.question import Part
from earthspin.engine.run import Run
from earthspin.scenes import load_scene
during = set()
original = Part.stored_or_computed
def watched(part, inputs):
    before = set(sys.modules)
    result = original(part, inputs)
    during.update(set(sys.modules) - before)
    return result
Part.stored_or_computed = watched
Run(load_scene({!r})).tree("all")
for name in set(sys.modules) - during:
    del sys.modules[name]
"""


@pytest.mark.slow
def test_run_times_of_parts_contain_no_import_of_a_large_library() -> None:
    """A run loads them before; a kernel is opened, with its reader, by the part of the sky."""
    scenes = [*shipped_scenes()]
    loaded = watched_after([DURING_PARTS.format(scene) for scene in scenes])
    light = {"jplephem", "erfa", "skyfield"}  # 1, 7 and 24 ms
    assert {scene: found - light for scene, found in zip(scenes, loaded, strict=True)} == {
        scene: set() for scene in scenes
    }


def test_skyfield_is_loaded_where_it_is_asked_for() -> None:
    """Not by the plan of it."""
    question = "earthspin.load_scene('torque', {'source': 'skyfield', 'step': '30 d'})"
    planned = modules_after(f"import earthspin; print(earthspin.plan({question}))")
    assert not planned & HEAVY
    assert "skyfield" in modules_after(f"import earthspin; earthspin.run({question})")


def test_planning_loads_numpy_at_most() -> None:
    """And no physics that a plan does not tell of."""
    program = """
import earthspin
from earthspin.scenes import shipped_scenes
for scene in shipped_scenes():
    print(earthspin.plan(scene), earthspin.plan(scene, "all"))
"""
    assert not modules_after(program) & HEAVY


def test_no_public_name_is_a_modules_name() -> None:
    """Of the modules right under the package, which importing them sets as its attributes."""
    import pkgutil

    import earthspin

    modules = {module.name for module in pkgutil.iter_modules(earthspin.__path__)}
    assert "questions" in modules
    assert not {name for name in earthspin.__all__ if not name.startswith("_")} & modules


def test_public_names_alone_are_shown() -> None:
    program = (
        "import earthspin; earthspin.plan('wobble'); earthspin.ensemble\n"
        "assert earthspin.bodies.JUPITER.name == 'jupiter'\n"
        "assert not hasattr(earthspin, 'nothing') and not hasattr(earthspin.views, 'nothing')\n"
        "assert dir(earthspin) == sorted([*earthspin.__all__, 'open'])\n"
        "for name in dir(earthspin): getattr(earthspin, name)\n"
        "assert dir(earthspin) == sorted([*earthspin.__all__, 'open'])\n"
        "from earthspin import *\nimport builtins\nassert open is builtins.open"
    )
    modules_after(program)


def test_the_accessor_is_registered_when_it_is_asked_for_or_by_the_first_call() -> None:
    look = "import earthspin.scenes, xarray\nassert not hasattr(xarray.Dataset, 'earthspin')\n"
    modules_after(f"{look}import earthspin.engine.accessor; assert xarray.Dataset.earthspin")
    modules_after(f"{look}assert earthspin.wobble_ladder().earthspin.scene")
