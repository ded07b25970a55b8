from __future__ import annotations

from pathlib import Path

from slider_resonator.output.html_page import write_page


def test_a_page_has_its_title_and_parts_and_needs_nothing_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    write_page(path, "a < b", ["<p>one</p>", "<p>two</p>"])
    page = path.read_text()
    assert "<title>a &lt; b</title>" in page
    assert page.index("<h1>a &lt; b</h1>") < page.index("<p>one</p>") < page.index("<p>two</p>")
    assert page.rstrip().endswith("</body></html>")
    assert "http" not in page
