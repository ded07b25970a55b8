"""The page: self-contained, with the ratios at its top and the omissions at its end."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from slider_resonator.trading.page import write_trades
from slider_resonator.trading.plots import draw_picture
from slider_resonator.trading.result import Omission
from tests.harness.known_provenance import PROVENANCE
from tests.harness.trading.test_needs import TRADE
from tests.html_pages import Page


def test_a_page_stands_alone(tmp_path: Path) -> None:
    gone = Omission("s", "slow <method>", "all", "more than its budget")
    trade = replace(TRADE, title="A & B", omissions=(gone,))
    write_trades(tmp_path / "index.html", [trade], PROVENANCE)
    text = (tmp_path / "index.html").read_text(encoding="utf-8")
    page = Page(text)
    assert page.loaded == ["data:,"], "nothing is fetched"
    assert text.index("at an error of 1e-09 in position") < text.index('class="plot"')
    assert page.ids == ["provenance"]
    assert "A &amp; B" in text
    assert "slow &lt;method&gt;" in text
    assert "averages and leaps: not reached" in text


def test_a_quantity_without_rows_has_no_plot(tmp_path: Path) -> None:
    write_trades(tmp_path / "index.html", [TRADE], PROVENANCE)
    assert (tmp_path / "index.html").read_text(encoding="utf-8").count('class="plot"') == 1


def test_the_picture_is_drawn_where_a_quantity_is_missing_too(tmp_path: Path) -> None:
    draw_picture(TRADE, tmp_path / "trade.png")
    assert (tmp_path / "trade.png").read_bytes().startswith(b"\x89PNG")
