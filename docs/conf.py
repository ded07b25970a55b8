"""The documentation site: `make docs` writes it to build/docs."""

import re
import shutil
from pathlib import Path

from sphinx.application import Sphinx

import slider_resonator

ROOT = Path(__file__).resolve().parents[1]

project = "slider-resonator"
author = "slider-resonator contributors"
version = release = slider_resonator.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc"]
html_theme = "furo"
html_theme_options = {
    "announcement": '<a href="slider-resonator.html">Run the component in your browser</a>'
}
html_static_path = ["_static"]
html_css_files = ["phone.css"]
html_title = f"slider-resonator {release}"
myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_typehints = "description"
suppress_warnings = ["myst.header", "myst.xref_missing"]

_SOURCE_FILE = re.compile(r"\[([^]]*)\]\((?:\.\./)+([^)#]*)(?:#[^)]*)?\)")
"""A link from a page to a file outside `docs`, which is not on the site."""


def setup(app: Sphinx) -> None:
    """Name files outside `docs` instead of linking to them; add the page that runs."""
    app.connect("source-read", _name_source_files)
    app.connect("build-finished", _copy_page)


def _name_source_files(app: Sphinx, name: str, source: list[str]) -> None:
    source[0] = _SOURCE_FILE.sub(r"\1 (`\2`)", source[0])


def _copy_page(app: Sphinx, error: Exception | None) -> None:
    page = ROOT / "dist" / "slider-resonator.html"
    if error is None and page.is_file():
        shutil.copy(page, app.outdir)
