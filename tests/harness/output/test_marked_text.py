from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.output.atomic import write_marked

BEGIN, END = "<!-- part -->", "<!-- end of part -->"


def test_a_new_file_holds_the_text_alone(tmp_path: Path) -> None:
    write_marked(tmp_path / "hosts.md", "the text", BEGIN, END)
    assert (tmp_path / "hosts.md").read_text() == "the text\n"


def test_a_file_with_marks_keeps_all_around_them(tmp_path: Path) -> None:
    path = tmp_path / "README.md"
    path.write_text(f"before\n{BEGIN}\nold\n{END}\nafter\n")
    write_marked(path, "new", BEGIN, END)
    assert path.read_text() == f"before\n{BEGIN}\nnew\n{END}\nafter\n"


@pytest.mark.parametrize("text", [BEGIN, END, END + BEGIN, BEGIN + END + BEGIN])
def test_marks_that_are_no_pair_are_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "README.md"
    path.write_text(text)
    with pytest.raises(HarnessError, match="must have one"):
        write_marked(path, "new", BEGIN, END)
    assert path.read_text() == text
