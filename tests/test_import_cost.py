"""Only what a scene needs is loaded, shown in fresh processes."""

import subprocess
import sys

import pytest


def modules_after(program: str) -> set[str]:
    """Top-level modules that a fresh process has imported after a program."""
    listing = "\nimport sys; print(' '.join(sorted({m.split('.')[0] for m in sys.modules})))"
    out = subprocess.run(
        [sys.executable, "-W", "error", "-c", program + listing],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    return set(out.splitlines()[-1].split())


def test_importing_costs_nothing() -> None:
    loaded = modules_after("import earthspin; earthspin.EARTH; earthspin.Body")
    assert not loaded & {"numpy", "scipy", "xarray", "astropy", "skyfield", "matplotlib"}


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


def test_the_observed_pole_needs_no_kernel() -> None:
    loaded = modules_after("import earthspin; earthspin.run('polar-motion')")
    assert not loaded & {"skyfield", "jplephem", "numba", "matplotlib", "erfa", "rich"}


@pytest.mark.parametrize("scene", ["precession", "sun-only", "torque"])
def test_a_scene_draws_nothing(scene: str) -> None:
    loaded = modules_after(f"import earthspin; earthspin.run({scene!r})")
    assert not loaded & {"matplotlib", "numba", "skyfield", "jinja2", "zarr", "dask", "rich"}
    assert "jplephem" in loaded


def test_planning_computes_nothing() -> None:
    loaded = modules_after(
        "import earthspin; print(earthspin.plan(earthspin.load_scene('torque')))"
    )
    # astropy.units reads the step
    assert not loaded & {"xarray", "scipy", "skyfield", "jplephem", "erfa", "matplotlib"}


def test_no_public_name_is_a_modules_name() -> None:
    import pkgutil

    import earthspin

    modules = {
        part
        for module in pkgutil.walk_packages(earthspin.__path__, "earthspin.")
        for part in module.name.split(".")[1:]
    }
    public = {name for name in earthspin.__all__ if not name.startswith("_")}
    # `torque` and `scene` are words of the grammar too, but not public names.
    assert not public & modules
