"""The package: its names, its words, and that all of it is delivered."""

import ast
import re
import subprocess
import sys
import tomllib
import zipfile
from collections import Counter
from pathlib import Path

import pytest
import yaml

import earthspin
from tests.processes import ROOT, printed

PACKAGE = Path(earthspin.__file__).parent
MODULES = sorted(
    ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts).removesuffix(".__init__")
    for path in PACKAGE.rglob("*.py")
    if path.name != "__main__.py"
)


def test_a_name_of_a_class_or_module_stands_for_one_thing() -> None:
    """The layers of a question share its name: `torque`, `questions.torque`, `views.torque`."""
    classes = Counter(
        node.name
        for path in PACKAGE.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.ClassDef)
    )
    assert [name for name, count in classes.items() if count > 1] == []
    layers = Counter(
        module.rpartition(".")[2]
        for module in MODULES
        if not module.startswith(("earthspin.questions.", "earthspin.views."))
        and (PACKAGE.parent / (module.replace(".", "/") + ".py")).exists()
    )
    assert [name for name, count in layers.items() if count > 1] == []


def test_the_project_speaks_of_itself_alone() -> None:
    if not (ROOT / ".git").exists():
        pytest.skip("the files of the project are known where it is checked out with git")
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    files = listed.stdout.split()
    assert "pyproject.toml" in files
    # Put together so that this file does not hold what it looks for.
    forbidden = re.compile("|".join(("/wo" + "rk/", "/ro" + "ot/", "/tm" + "p/", "index-" + "url")))
    for name in files:
        path = ROOT / name
        if path.suffix in {".py", ".md", ".toml", ".json", ".yml", ".cfg", ".j2", ""} and (
            path.is_file()
        ):
            assert not forbidden.search(path.read_text("utf-8", errors="replace")), name


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run(
        [
            *(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps"),
            *("--no-build-isolation", "--wheel-dir", str(folder), str(ROOT)),
        ],
        check=True,
        capture_output=True,
    )
    return next(folder.glob("*.whl"))


@pytest.mark.slow
def test_the_wheel_holds_every_module_and_nothing_else(wheel: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        archive.extractall(tmp_path)
    assert all(n.startswith(("earthspin/", f"earthspin-{earthspin.__version__}")) for n in names)
    assert "earthspin/py.typed" in names
    scenes = {f"earthspin/shipped/{path.name}" for path in (PACKAGE / "shipped").glob("*.toml")}
    assert len(scenes) > 15
    assert scenes <= set(names)
    program = (
        f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n"
        "import importlib, earthspin\n"
        f"assert earthspin.__file__.startswith({str(tmp_path)!r})\n"
        f"for name in {MODULES!r}: importlib.import_module(name)\n"
        "for name in earthspin.__all__: getattr(earthspin, name)\n"
        "from earthspin.scenes import shipped_scenes\n"
        f"assert list(shipped_scenes()) == {sorted(Path(name).stem for name in scenes)!r}\n"
        "for name in shipped_scenes(): earthspin.load_scene(name)\n"
        "from earthspin.views.page import PackageLoader\n"
        "PackageLoader('earthspin.views').get_source("
        "__import__('jinja2').Environment(), 'page.html.j2')\n"
    )
    printed(program, cwd=tmp_path)


def test_the_conda_recipe_asks_for_what_the_package_asks_for() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    recipe = yaml.safe_load((ROOT / "conda/recipe.yaml").read_text())
    context = recipe["context"]
    assert context["version"] == earthspin.__version__
    assert f">={context['python_min']}" == project["requires-python"]
    # conda-forge divides these two into a core and what only its developers need.
    core = {"astropy": "astropy-base", "matplotlib": "matplotlib-base"}
    asked = [re.fullmatch(r"([\w-]+)(>=.+)", line) for line in project["dependencies"]]
    wanted = {f"{core.get(m[1], m[1].lower())} {m[2]}" for m in asked if m}
    python, *others = recipe["requirements"]["run"]
    assert python == "python >=${{ python_min }}"
    assert len(asked) == len(wanted) == len(others)
    assert set(others) == wanted
