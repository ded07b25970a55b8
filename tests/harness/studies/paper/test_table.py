from __future__ import annotations

from slider_resonator.studies.paper.table import PaperTable

COLUMNS = {"kappa": "kappa", "error": "e", "other": "o"}
TABLE = PaperTable("t", "T", "", COLUMNS, {"error": 0.1, "other": 1.0}, lambda i: {})


def test_deviations_of_either_sign_are_judged_by_their_size() -> None:
    data = {"rows": [{"kappa": 9.0, "error": -0.1, "other": 0.0}, {"error": 0.05, "other": 1.0}]}
    assert TABLE.largest(data) == {"error": 0.1, "other": 1.0}
    assert TABLE.confirmed(data)


def test_one_deviation_too_large_is_enough() -> None:
    assert not TABLE.confirmed({"rows": [{"error": -0.11, "other": 0.0}]})
    assert not TABLE.confirmed({"rows": [{"error": 0.0, "other": 0.0}, {"error": 0, "other": 2}]})
