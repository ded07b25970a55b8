from __future__ import annotations

from pathlib import Path

import pytest
from matplotlib.axes import Axes

from slider_resonator.errors import HarnessError
from slider_resonator.sweeping.grid import grid_from, read_grid
from slider_resonator.sweeping.measures import Row
from slider_resonator.sweeping.picture import check_picture, sweep_figure
from slider_resonator.sweeping.table import table_columns

AXIS = "{ from = 0.0, to = 1.0, count = 8 }"


@pytest.mark.parametrize(
    ("text", "drawn"),
    [
        (f"[grid]\nphase = {AXIS}", "line"),
        (f"[grid]\nphase = {AXIS}\nload = [0.0, 0.1]", "line"),
        (f"[grid]\nphase = {AXIS}\nload = {AXIS}", "pcolormesh"),
        ("[list]\nphase = [0.0, 0.1]\nload = [0.0, 0.1]", "scatter"),
    ],
)
def test_lines_maps_and_samples_are_drawn_with_gaps_for_failures(
    text: str, drawn: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    used: list[str] = []
    methods = {"line": "plot", "pcolormesh": "pcolormesh", "scatter": "scatter"}
    for kind, method in methods.items():
        original = getattr(Axes, method)

        def noted(
            *args: object, _kind: str = kind, _do: object = original, **more: object
        ) -> object:
            used.append(_kind)
            return _do(*args, **more)  # type: ignore[operator]

        monkeypatch.setattr(Axes, method, noted)
    (tmp_path / "grid.toml").write_text(text, encoding="utf-8")
    sweep = read_grid(tmp_path / "grid.toml")
    rows: dict[int, Row] = {
        n: (n, [float(n) - 3.0, "steady"], None) for n in range(len(sweep.points))
    }
    rows[1] = (1, [None, None], "refused")
    sweep_figure(sweep, table_columns(sweep.task, sweep.points, rows))
    assert used[0] == drawn, "a colour bar may follow"


def test_three_variables_have_no_picture(tmp_path: Path) -> None:
    path = tmp_path / "grid.toml"
    path.write_text("[grid]\nphase = [0]\nload = [0]\nfriction_law = [0]", encoding="utf-8")
    with pytest.raises(HarnessError, match=r"3 variables.*must be one"):
        check_picture(read_grid(path), "--plot")


def test_axes_are_logarithmic_where_the_grid_is() -> None:
    scales: list[tuple[str, str]] = []
    log = {"from": 0.1, "to": 10.0, "count": 8, "spacing": "log"}
    for names in (["friction_coefficient"], ["friction_coefficient", "load"]):
        grid = {name: log for name in names}
        sweep = grid_from({"grid": grid}, "grid.toml")
        rows: dict[int, Row] = {n: (n, [1.0, ""], None) for n in range(len(sweep.points))}
        axes = sweep_figure(sweep, table_columns(sweep.task, sweep.points, rows)).axes[0]
        scales.append((axes.get_xscale(), axes.get_yscale()))
    assert scales == [("log", "linear"), ("log", "log")]
