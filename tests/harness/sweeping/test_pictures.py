"""Page and picture of a sweep."""

from math import pi
from pathlib import Path
from typing import Any

import pytest
from matplotlib.collections import PathCollection, QuadMesh
from matplotlib.lines import Line2D

from slider_resonator.errors import HarnessError
from slider_resonator.sweeping.grid import Sweep, grid_from
from slider_resonator.sweeping.measures import Row
from slider_resonator.sweeping.page import MAX_POINTS, check_page, write_sweep_page
from slider_resonator.sweeping.picture import sweep_figure
from slider_resonator.sweeping.table import Columns, table_columns
from tests.harness.known_provenance import PROVENANCE
from tests.html_pages import Page

AXIS = {"from": 0.0, "to": 1.0, "count": 8}
LOGARITHMIC_RANGE = {"from": 0.1, "to": 10.0, "spacing": "log"}
LOGARITHMIC = {**LOGARITHMIC_RANGE, "count": 8}


def columns_of(sweep: Sweep, *, answered: bool = True) -> Columns:
    """The table of a sweep whose second point is refused, or in which nothing has an answer."""
    rows: dict[int, Row] = {
        n: (n, [float(n) - 3.0, "steady"] if answered else [None, "beat"], None)
        for n in range(len(sweep.points))
    }
    rows[1] = (1, [None, None], "<refused>")
    return table_columns(sweep.task, sweep.points, rows.values())


def plots(path: Path, content: dict[str, Any], *, answered: bool = True) -> list[dict[str, Any]]:
    """The data of the plots on the page of a sweep."""
    sweep = grid_from(content, "grid.toml")
    write_sweep_page(path, sweep, columns_of(sweep, answered=answered), PROVENANCE)
    text = path.read_text(encoding="utf-8")
    page = Page(text)
    assert page.loaded == ["data:,"]
    assert page.ids == ["provenance"]
    assert "0123abcd" in text
    return page.plots


def test_a_line_has_every_point_with_what_it_is(tmp_path: Path) -> None:
    (plot,) = plots(tmp_path / "a.html", {"grid": {"phase": AXIS}, "title": "<i>"})
    line, missing = plot["series"]
    assert plot["x"]["label"] == "phase [deg]"
    assert plot["y"]["label"] == "steady velocity [m/s]"
    assert line["y"] == [-3.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0]
    assert line["notes"][0] == "steady velocity [m/s]: -3\nsteady"
    assert missing["x"] == [pytest.approx(180.0 / pi / 7.0)]
    assert missing["y"] == [None]
    assert missing["notes"] == ["no answer\n<refused>"]


def test_few_values_are_lines_that_differ_and_many_are_cells(tmp_path: Path) -> None:
    (lines,) = plots(tmp_path / "a.html", {"grid": {"phase": AXIS, "load": [0.0, 0.1]}})
    drawn = [one for one in lines["series"] if one["width"] > 0]
    assert [one["label"] for one in drawn] == ["load 0 mN", "load 100 mN"]
    assert drawn[0]["colour"] != drawn[1]["colour"]
    assert drawn[0]["marker"] != drawn[1]["marker"]
    (cells,) = plots(tmp_path / "a.html", {"grid": {"phase": AXIS, "load": AXIS}})
    assert cells["series"][0]["cells"]
    assert len(cells["series"][0]["colours"]) == 63
    assert cells["y"]["label"] == "load [N]"


def test_axes_are_logarithmic_where_the_grid_is(tmp_path: Path) -> None:
    grid = {"friction_coefficient": LOGARITHMIC, "phase": AXIS}
    (plot,) = plots(tmp_path / "a.html", {"grid": grid})
    assert (plot["x"]["log"], plot["y"]["log"]) == (True, False)
    content = {"random": {"count": 9, "seed": 1, "friction_coefficient": LOGARITHMIC_RANGE}}
    (plot,) = plots(tmp_path / "a.html", content)
    assert plot["x"]["log"]


def test_a_sweep_without_any_answer_has_a_page(tmp_path: Path) -> None:
    (plot,) = plots(tmp_path / "a.html", {"grid": {"phase": AXIS, "load": AXIS}}, answered=False)
    assert [one["label"] for one in plot["series"]] == ["no answer"]


def test_too_many_points_are_refused() -> None:
    axis = {"from": 0.0, "to": 1.0, "count": MAX_POINTS + 1}
    with pytest.raises(HarnessError, match=f"--html: {MAX_POINTS + 1} points; must be at most"):
        check_page(grid_from({"grid": {"phase": axis}}, "a"), "--html")


@pytest.mark.parametrize(
    ("content", "drawn"),
    [
        ({"grid": {"phase": AXIS}}, Line2D),
        ({"grid": {"phase": AXIS, "load": [0.0, 0.1]}}, Line2D),
        ({"grid": {"phase": AXIS, "load": AXIS}}, QuadMesh),
        ({"list": {"phase": [0.0, 0.1], "load": [0.0, 0.1]}}, PathCollection),
    ],
)
def test_lines_maps_and_samples_are_drawn(content: dict[str, Any], drawn: type) -> None:
    sweep = grid_from(content, "grid.toml")
    axes = sweep_figure(sweep, columns_of(sweep)).axes[0]
    assert isinstance([*axes.collections, *axes.lines][0], drawn)
