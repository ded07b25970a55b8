"""Texts against the files in the folder `screens`, which `UPDATE_SCREENS=1 pytest` writes anew."""

import os
import re
from pathlib import Path

from tests.html_pages import Page

SCREENS = Path(__file__).parent / "screens"


def assert_as_before(name: str, text: str) -> None:
    """Compare a text with the file of that name; review what an update changes."""
    file = SCREENS / name
    if os.environ.get("UPDATE_SCREENS"):
        file.write_text(text, encoding="utf-8")
    assert text == file.read_text(encoding="utf-8")


def assert_page_as_before(name: str, page: Path) -> None:
    """Compare a page, which must load nothing, with the file of that name.

    What is compared has neither scripts, plots and styles nor the policy that names the scripts.
    """
    read = Page.read(page)
    assert all(one == "data:," or one[1:] in read.ids for one in read.loaded), "within the page"
    html = page.read_text(encoding="utf-8")
    html = re.sub(r"<(style|script)\b.*?</\1>|<meta http-equiv[^>]*>", "", html, flags=re.DOTALL)
    assert_as_before(name, re.sub(r"\s*(<(?:tr|p|h\d|details|div)\b)", r"\n\1", html))
