from __future__ import annotations

from pathlib import Path
from types import FunctionType
from typing import cast

from slider_resonator.studies.paper import figure_3, figure_4
from slider_resonator.studies.paper.store import key_of, store, stored

MEASURE = cast(FunctionType, figure_3.FIGURE.measure)


def test_a_key_changes_with_all_that_results_depend_on() -> None:
    other = cast(FunctionType, figure_4.FIGURE.measure)
    keys = {
        key_of({"q": 1.0}, "a", MEASURE),
        key_of({"q": 2.0}, "a", MEASURE),
        key_of({"q": 1.0}, "b", MEASURE),
        key_of({"q": 1.0}, "a", other),
    }
    assert len(keys) == 4
    assert key_of({"q": 1.0}, "a", MEASURE) in keys, "and with nothing else"


def test_results_are_found_under_their_key_only(tmp_path: Path) -> None:
    path = tmp_path / "results" / "x.json"
    assert stored(path, "key") is None
    assert store(path, "key", {"v": (1.0, None)}) == {"v": [1.0, None]}
    assert stored(path, "key") == {"v": [1.0, None]}
    assert stored(path, "other") is None


def test_a_damaged_file_counts_as_missing(tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    for text in ("{", "[]", "\x00"):
        path.write_text(text, encoding="utf-8")
        assert stored(path, "key") is None
