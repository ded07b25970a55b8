"""Texts against the files in the folder `screens`, which `UPDATE_SCREENS=1 pytest` writes anew."""

import os
import re
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.output.readable import escaped
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


def without_long_lists(message: str) -> str:
    """Leave out long lists of allowed names, which come and go."""
    return re.sub(r" [(]must be one of [^)]{60,}[)]", "", message)


def mistakes_in(name: str) -> dict[str, str]:
    """Return the texts in a file of mistakes by themselves: each is above what is said of it."""
    *texts, _ = re.split("(?m)(?:^ {4}.*\n)+", (SCREENS / name).read_text(encoding="utf-8"))
    return {text[:-1]: text[:-1] for text in texts}


def assert_mistakes_as_before(
    name: str, file: Path, texts: Mapping[str, str], read: Callable[[Path], object]
) -> None:
    """Compare why `read` refuses a file of each text, by its mistake, with the file of that name.

    The words of the reader of TOML, and long lists of names, which come and go, are left out.
    """
    said = []
    for mistake, text in texts.items():
        file.write_text(text, encoding="utf-8")
        with pytest.raises(HarnessError) as refusal:
            read(file)
        message = escaped(str(refusal.value)).replace(f"{file.parent}/", "")
        assert all(line.startswith(file.name) for line in message.splitlines())
        message = re.sub(r"not TOML: [^;]*;", "not TOML;", message)
        message = without_long_lists(message)
        said.append(f"{mistake}\n" + "".join(f"    {line}\n" for line in message.splitlines()))
    assert_as_before(name, "".join(said))
