"""Sphinx settings."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

import earthspin

project = "earthspin"
author = "the earthspin developers"
release = earthspin.__version__
extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "myst_nb",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "course",
    "equation_map",
    "gallery_picture",
    "native_math",
    "page_checks",
    "scene_keys",
]
html_theme = "pydata_sphinx_theme"
html_theme_options = {
    "secondary_sidebar_items": ["page-toc"],
    "header_links_before_dropdown": 10,
    "show_toc_level": 2,
}
html_sidebars = {"**": ["pages.html"]}
html_static_path = ["_static"]
html_css_files = ["earthspin.css"]
html_math_renderer = "native"
html_title = "earthspin"
templates_path = ["_templates"]
exclude_patterns = [
    "_build", "_templates", "jupyter_execute", "examples", "gallery", "paper",
    "auto_gallery/**/*.ipynb",
]  # fmt: skip
sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "auto_gallery",
    "nested_sections": False,
    "subsection_order": [
        f"gallery/{section}"
        for section in (
            "bodies", "free_rotors", "top", "torques", "precession", "long_term", "pole",
            "nutation", "rotation", "wobble", "many",
        )
    ],
    "within_subsection_order": "FileNameSortKey",
    "reset_modules": ("gallery_figures.journal",),
    "image_scrapers": ("gallery_figures.one_figure",),
    "image_srcset": ["2x"],
    "abort_on_example_error": True,
    "capture_repr": (),
    "remove_config_comments": True,
    "show_memory": False,
    "show_signature": False,
    "min_reported_time": 1e9,
    "thumbnail_size": (480, 336),
    "write_computation_times": False,
}  # fmt: skip
myst_enable_extensions = ["dollarmath", "amsmath", "deflist", "attrs_block"]
nb_execution_mode = "force"
# {eval} on a page takes any expression, so that a page formats its own numbers.
nb_eval_name_regex = r"^[^`]+$"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_merge_streams = True
nb_render_markdown_format = "myst"
autosummary_generate = True
autodoc_typehints = "none"
numpydoc_show_class_members = False
numpydoc_xref_param_type = False
suppress_warnings = ["mystnb.unknown_mime_type"]


def keep_absolute_values(app, what, name, obj, options, lines):
    """Write |x| in docstrings as it is meant, not as a substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def setup(app):
    app.connect("autodoc-process-docstring", keep_absolute_values, priority=900)
