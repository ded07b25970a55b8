"""The grid files in the documentation are valid, and of the documented size."""

from __future__ import annotations

import re
from pathlib import Path

from slider_resonator.sweeping.grid import read_grid
from slider_resonator.sweeping.picture import check_picture

DOCS = Path(__file__).parents[2] / "docs"


def test_the_map_has_40_000_points_that_all_repeat() -> None:
    sweep = read_grid(DOCS / "steady_velocity.toml")
    check_picture(sweep, "--plot")
    assert len(sweep.points) == 40_000
    ratios = {ratio for ratio, _ in sweep.points}
    assert all(abs(20.0 * ratio - round(20.0 * ratio)) < 1e-9 for ratio in ratios)


def test_the_grids_of_the_page_are_read(tmp_path: Path) -> None:
    page = (DOCS / "sweeps.md").read_text(encoding="utf-8")
    counts = []
    for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL):
        (tmp_path / "grid.toml").write_text(text, encoding="utf-8")
        counts.append(len(read_grid(tmp_path / "grid.toml").points))
    assert counts == [63 * 3 * 10, 3 * 41]
