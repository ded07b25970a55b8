"""Grids, the tables that sweeps write, their page and picture."""

import csv
import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.collections import PathCollection, QuadMesh
from matplotlib.lines import Line2D
from pyarrow import parquet

from slider_resonator.errors import HarnessError
from slider_resonator.sweeping import sweeping
from slider_resonator.sweeping.grid import Sweep, grid_from, read_grid
from slider_resonator.sweeping.measures import Columns, Row, Run, Task
from slider_resonator.sweeping.picture import sweep_figure, write_sweep_page
from slider_resonator.sweeping.sweeping import check_writer, table_columns, write_table
from tests.harness.golden import assert_as_before, assert_mistakes_as_before
from tests.harness.known_provenance import PROVENANCE
from tests.html_pages import Page


def _read(text: str) -> Sweep:
    return grid_from(tomllib.loads(text), "grid.toml")


def test_the_last_axis_varies_fastest_and_ends_are_exact() -> None:
    sweep = _read("[grid]\nphase = [0.0, 1.0]\nload = { from = 0.0, to = 0.3, count = 3 }")
    assert sweep.task.names == ("phase", "load")
    assert sweep.points == ((0, 0), (0, 0.15), (0, 0.3), (1, 0), (1, 0.15), (1, 0.3))
    assert sweep.is_grid


def test_a_log_axis_has_equal_ratios() -> None:
    axis = '{ from = 1e3, to = 1e7, count = 5, spacing = "log" }'
    sweep = _read(f"[grid]\nbristle_stiffness = {axis}")
    assert [v for (v,) in sweep.points] == pytest.approx([1e3, 1e4, 1e5, 1e6, 1e7], rel=1e-14)


def test_values_may_have_a_unit() -> None:
    text = (
        '[fixed]\nload = "50 mN"\n[grid]\nphase = { from = "0 deg", to = "180 deg", count = 3 }\n'
        '[list]\ndrive_frequency = ["20 kHz", 1e5]\n'
    )
    sweep = _read(text)
    assert dict(sweep.task.fixed) == {"load": 0.05}
    frequencies = (40e3 * math.pi, 1e5)
    expected = [(phase, w) for phase in (0.0, math.pi / 2.0, math.pi) for w in frequencies]
    assert np.array(sweep.points) == pytest.approx(np.array(expected))


def test_grid_list_and_random_are_combined() -> None:
    text = (
        "[grid]\nphase = [0.0, 1.0]\n[list]\nload = [0.0, 0.1]\nfrequency_ratio = [1, 3]\n"
        "[random]\ncount = 5\nseed = 7\ndamping_ratio = { from = 0.01, to = 0.1 }"
    )
    sweep = _read(text)
    assert sweep.task.names == ("phase", "load", "frequency_ratio", "damping_ratio")
    assert len(sweep.points) == 2 * 2 * 5
    assert {point[1:3] for point in sweep.points} == {(0.0, 1.0), (0.1, 3.0)}, "side by side"
    assert all(0.01 <= point[3] <= 0.1 for point in sweep.points)
    assert not sweep.is_grid


def test_a_seed_gives_the_same_sample_and_another_seed_another() -> None:
    def sample(seed: int) -> tuple[tuple[float, ...], ...]:
        text = f"[random]\ncount = 3\nseed = {seed}\nload = {{ from = 0, to = 1 }}"
        return _read(text).points

    assert sample(1) == sample(1)
    assert sample(1) != sample(2)
    assert sample(1)[0][0] == 0.13436424411240122, "the first number of Python's generator"


def test_an_invalid_grid_is_refused_with_name_value_and_requirement(tmp_path: Path) -> None:
    assert_mistakes_as_before("grid_mistakes.txt", tmp_path / "grid.toml", read_grid)


TASK = Task(("fidelity", "phase"), (), ("steady_velocity",), 20, Run())
POINTS = ((0.0, 0.1), (2.0, 0.1 + 0.2))
ROWS: list[Row] = [(0, [None, None], 'load, "x"'), (1, [1.0 / 3.0, "steady"], None)]


def test_tables_give_back_the_same_numbers(tmp_path: Path) -> None:
    """Of parquet in typed columns, in the order of the points."""
    columns, kinds = table_columns(TASK, POINTS, ROWS), ["int64"] * 2 + ["double"] * 2
    for suffix in ("parquet", "csv"):
        write_table(tmp_path / f"a.{suffix}", TASK, columns)
    typed = parquet.read_table(tmp_path / "a.parquet")
    assert typed.to_pydict() == columns
    assert [str(kind) for kind in typed.schema.types] == [*kinds, "string", "string"]
    with (tmp_path / "a.csv").open(encoding="utf-8", newline="") as file:
        first, second = csv.DictReader(file)
    assert (first["error"], first["steady_velocity"]) == ('load, "x"', "")
    assert second["fidelity"] == "2"
    assert [float(second[name]) for name in ("phase", "steady_velocity")] == [0.1 + 0.2, 1.0 / 3.0]


def test_without_pyarrow_only_csv_is_possible(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sweeping, "find_spec", lambda name: None)
    check_writer(Path("a.csv"))
    with pytest.raises(HarnessError, match=r"pip install 'slider-resonator\[parquet\]'"):
        check_writer(Path("a.parquet"))


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


LINE = {"title": "<i>", "grid": {"phase": AXIS}}
FEW_LINES = {"grid": {"phase": AXIS, "load": [0.0, 0.1]}}
MAP = {"grid": {"phase": AXIS, "load": AXIS}}
LOGARITHMIC_MAP = {"grid": {"friction_coefficient": LOGARITHMIC, "phase": AXIS}}
SAMPLE = {"random": {"count": 9, "seed": 1, "friction_coefficient": LOGARITHMIC_RANGE}}


def test_plots_of_pages(tmp_path: Path) -> None:
    """Every point with what it is; few values are lines that differ, and many are cells."""
    said, page = [], tmp_path / "a.html"
    for content in (LINE, FEW_LINES, MAP, LOGARITHMIC_MAP, SAMPLE, None):
        sweep = grid_from(content or MAP, "grid.toml")
        columns = columns_of(sweep, answered=content is not None)
        write_sweep_page(page, sweep, columns, PROVENANCE)
        read = Page.read(page)
        assert (read.loaded, read.ids) == (["data:,"], ["provenance"])
        (plot,) = read.plots
        shown = [f"{key}: {value}" for one in plot.pop("series") for key, value in one.items()]
        said += [f"{content or 'nothing has an answer'}\n", f"{plot}\n"]
        said += [f"    {line}\n" for line in shown]
    assert_as_before("sweep_plots.txt", "".join(said))


def test_a_sweep_without_any_answer_is_drawn_and_says_so() -> None:
    sweep = grid_from(MAP, "grid.toml")
    (axes,) = sweep_figure(sweep, columns_of(sweep, answered=False)).axes
    assert axes.get_legend_handles_labels()[1] == ["steady velocity: no answer"]
    assert axes.get_legend() is not None


@pytest.mark.parametrize(
    ("content", "drawn"),
    [
        (LINE, Line2D),
        (FEW_LINES, Line2D),
        (MAP, QuadMesh),
        ({"list": {"phase": [0.0, 0.1], "load": [0.0, 0.1]}}, PathCollection),
    ],
)
def test_lines_maps_and_samples_are_drawn(content: dict[str, Any], drawn: type) -> None:
    sweep = grid_from(content, "grid.toml")
    axes = sweep_figure(sweep, columns_of(sweep)).axes[0]
    assert isinstance([*axes.collections, *axes.lines][0], drawn)
