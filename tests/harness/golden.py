"""Texts against the files in the folder `screens`, which `UPDATE_SCREENS=1 pytest` writes anew."""

import io
import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from rich.console import Console

from slider_resonator.errors import HarnessError
from slider_resonator.output.readable import escaped
from tests.html_pages import Page

SCREENS = Path(__file__).parent / "screens"


def screen(show: Callable[[Console], None], width: int) -> str:
    """What `show` prints on a terminal without colours, without blanks at the ends of lines."""
    console = Console(
        file=io.StringIO(), width=width, force_terminal=True, color_system=None, highlight=False
    )
    show(console)
    assert isinstance(console.file, io.StringIO)
    return "".join(f"{line.rstrip()}\n" for line in console.file.getvalue().splitlines())


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


def mistakes_in(name: str) -> list[tuple[str, str]]:
    """Return what is wrong and the text of each mistake in the file of that name.

    There the text is below a line of what is wrong, which may be left out, and above what is said
    of it, which is indented; a line of "    ?" does until an update writes it.
    """
    blocks = re.split(r"(?m)(?:^ {4}.*\n)+", (SCREENS / name).read_text(encoding="utf-8"))[:-1]
    found = (re.fullmatch(r"(## [^\n]*\n)?(.*)\n", block, re.DOTALL) for block in blocks)
    return [(mistake[1] or "", mistake[2]) for mistake in found if mistake]


def assert_mistakes_as_before(
    name: str, file: Path, read: Callable[[Path], object], head: str = ""
) -> None:
    """Compare why `read` refuses each mistake of a file in `screens`, below a head, with that file.

    The words of the reader of TOML, and long lists of names, which come and go, are left out.
    """
    said = []
    for heading, text in mistakes_in(name):
        file.write_text(head + text, encoding="utf-8")
        with pytest.raises(HarnessError) as refusal:
            read(file)
        message = escaped(str(refusal.value)).replace(f"{file.parent}/", "")
        assert all(line.startswith(file.name) for line in message.splitlines())
        message = re.sub(r"not TOML: [^;]*;", "not TOML;", message)
        message = without_long_lists(message)
        reasons = "".join(f"    {line}\n" for line in message.splitlines())
        said.append(f"{heading}{text}\n{reasons}")
    assert_as_before(name, "".join(said))
