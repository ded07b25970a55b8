import base64
import hashlib
import re
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.output.hover_plot import (
    COLOURS,
    DASHES,
    MARKERS,
    Axis,
    HoverPlot,
    Series,
    look,
    plot_html,
)
from slider_resonator.output.html_page import write_page
from slider_resonator.output.plot_style import plot_unit
from tests.html_pages import Page

SERIES = Series("an FMU", [1.0, 2.0], [0.5, None], "#000", notes=["one", "two"])
PLOT = HoverPlot("A plot", Axis("time [s]"), Axis("velocity [m/s]", log=True), [SERIES])
HOSTILE = "</script><script>alert(1)</script><img onerror=x>\x1b[31m"


def written(folder: Path, plot: HoverPlot) -> tuple[str, Page]:
    path = folder / "page.html"
    write_page(path, "title", [plot_html(plot)])
    text = path.read_text(encoding="utf-8")
    return text, Page(text)


def test_a_page_has_its_data_and_allows_its_own_scripts_only(tmp_path: Path) -> None:
    text, page = written(tmp_path, PLOT)
    assert page.loaded == ["data:,"]
    assert page.plots[0]["y"] == {"label": "velocity [m/s]", "log": True, "range": None}
    (policy,) = re.findall('Content-Security-Policy" content="([^"]*)"', text)
    assert "default-src 'none'" in policy
    allowed = re.findall("sha256-([^']*)", policy)
    run = re.findall("<script>(.*?)</script>", text, re.DOTALL)
    digests = [base64.b64encode(hashlib.sha256(s.encode()).digest()).decode() for s in run]
    assert digests == allowed
    assert len(digests) == 2


def test_hostile_text_stays_text(tmp_path: Path) -> None:
    series = replace(SERIES, label=HOSTILE, notes=[HOSTILE, ""])
    plot = HoverPlot(HOSTILE, Axis(HOSTILE), Axis("y"), [series])
    text, page = written(tmp_path, plot)
    assert page.tags.count("script") == 3
    assert "img" not in page.tags
    assert "\x1b" not in text
    assert page.plots[0]["x"]["label"] == HOSTILE.replace("\x1b", "\ufffd")


def test_series_differ_in_colour_marker_or_dash() -> None:
    looks = [look(index) for index in range(80)]
    assert len(set(looks)) == 80
    assert len({colour for colour, _, _ in looks[: len(COLOURS)]}) == len(COLOURS)
    assert len({marker for _, marker, _ in looks[: len(MARKERS)]}) == len(MARKERS)
    assert {dash for _, _, dash in looks} == set(DASHES)


@pytest.mark.parametrize(
    ("unit", "peak", "expected"),
    [
        ("m", 9e-5, (1e6, "um")),
        ("m", -2e-4, (1e3, "mm")),
        ("m", 30.0, (1.0, "m")),
        ("m/s", 0.127, (1e3, "mm/s")),
        ("s", 0.2, (1e3, "ms")),
        ("s", 4.0, (1.0, "s")),
        ("N", 0.085, (1e3, "mN")),
        ("rad", 0.6, (180.0 / pi, "deg")),
        ("rad/s", 3500.0, (0.5 / pi, "Hz")),
        ("rad/s", 4e4 * pi, (5e-4 / pi, "kHz")),
        ("1", 1e-3, (1.0, "1")),
    ],
)
def test_the_unit_suits_the_peak(unit: str, peak: float, expected: tuple[float, str]) -> None:
    assert plot_unit(unit, np.array([0.0, peak])) == expected
