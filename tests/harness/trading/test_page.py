"""The page: self-contained, with the ratios at its top and the omissions at its end."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from slider_resonator.trading.page import write_trades
from slider_resonator.trading.plots import draw_picture, trade_figure
from slider_resonator.trading.result import AVERAGED, PEER, RESOLVED, Omission
from tests.harness.known_provenance import PROVENANCE
from tests.harness.trading.test_needs import TRADE, named
from tests.harness.trading.test_result import row
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
    assert "averaged: not reached" in text


def test_a_quantity_without_rows_has_no_plot(tmp_path: Path) -> None:
    write_trades(tmp_path / "index.html", [TRADE], PROVENANCE)
    assert (tmp_path / "index.html").read_text(encoding="utf-8").count('class="plot"') == 1


def test_the_picture_is_drawn_where_a_quantity_is_missing_too(tmp_path: Path) -> None:
    draw_picture(TRADE, tmp_path / "trade.png")
    assert (tmp_path / "trade.png").read_bytes().startswith(b"\x89PNG")


def test_names_in_the_picture_are_over_nothing_else() -> None:
    """Two models of the same error, leaps whose error falls, and peers among them."""
    models = {"2": (5e-4, 2e-13), "1": (4e-4, 2e-3), "0, order 1": (3e-5, 2e-3)}
    rows = []
    for build, factor in (("native", 1.0), ("Python", 100.0)):
        for model, (cost, error) in models.items():
            for share in (1.0, 3.0, 80.0):
                one = row(factor * share * cost, error, RESOLVED)
                rows.append(named(one, f"{build} FMU, fidelity {model}", f"{share}"))
        for n in range(5):
            one = row(factor * 1e-4 * 1.4**n, 1e-5 * 0.05**n, AVERAGED)
            rows.append(named(one, f"{build} FMU, fidelity 0, order 2", f"tol {n}"))
    rows += [named(row(1e-2 * 1.3**n, 1e-5 * 0.1**n, PEER), "heyoka", f"tol {n}") for n in range(6)]
    axes = trade_figure(replace(TRADE, rows=tuple(rows))).axes[0]
    assert len({text.get_text() for text in axes.texts}) == 8
    boxes = [text.get_window_extent() for text in axes.texts]
    for index, (text, box) in enumerate(zip(axes.texts, boxes, strict=True)):
        assert axes.bbox.count_contains(box.corners()) == 4, "a name is within the plot"
        assert not box.count_overlaps(boxes[:index]), text.get_text()
        for line in axes.lines:
            markers = line.get_transform().transform(line.get_xydata())
            assert not box.count_contains(markers), text.get_text()
