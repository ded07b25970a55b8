from __future__ import annotations

import json
from dataclasses import dataclass

from slider_resonator.output.json_output import SCHEMA_VERSION, to_json


@dataclass(frozen=True)
class Result:
    value: float
    multipliers: tuple[complex, ...]
    note: str | None


def test_numbers_that_json_does_not_know_become_null() -> None:
    text = to_json({"a": float("nan"), "b": [float("inf"), 1.5], "c": True})
    plain = {"schema_version": SCHEMA_VERSION, "a": None, "b": [None, 1.5], "c": True}
    assert json.loads(text) == plain


def test_dataclasses_and_complex_numbers_keep_all_digits() -> None:
    plain = json.loads(to_json(Result(0.1266669970173598, (0.5 + 0.25j,), None)))
    assert plain == {
        "schema_version": SCHEMA_VERSION,
        "value": 0.1266669970173598,
        "multipliers": [[0.5, 0.25]],
        "note": None,
    }


def test_each_object_at_the_top_and_no_other_has_the_version() -> None:
    plain = json.loads(to_json([{"inner": [{}]}, Result(1.0, (), None)]))
    assert [entry["schema_version"] for entry in plain] == [SCHEMA_VERSION] * 2
    assert plain[0]["inner"] == [{}]
