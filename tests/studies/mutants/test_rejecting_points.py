from __future__ import annotations

from studies.mutants.rejecting_points import RejectingPoints


def test_what_rejected_a_variant_of_the_file_last_comes_first() -> None:
    rejecting = RejectingPoints()
    assert rejecting.first("a.py", [1, 2, 3]) == [1, 2, 3]
    for point in (3, 2, 3, 9):
        rejecting.add("a.py", point)
    assert rejecting.first("a.py", [1, 2, 3]) == [3, 2, 1], "9 is not among the points"
    assert rejecting.first("b.py", [1, 2, 3]) == [1, 2, 3]
