from __future__ import annotations

import pytest

from fmu_src.building.build_error import BuildError
from fmu_src.building.dates import date_of_build, date_text


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (None, "1980-01-01T00:00:00Z"),
        ("0", "1970-01-01T00:00:00Z"),
        ("1700000000", "2023-11-14T22:13:20Z"),
    ],
)
def test_the_date_is_never_that_of_the_build(
    monkeypatch: pytest.MonkeyPatch, seconds: str | None, text: str
) -> None:
    if seconds is None:
        monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    else:
        monkeypatch.setenv("SOURCE_DATE_EPOCH", seconds)
    assert date_text(date_of_build()) == text


@pytest.mark.parametrize("seconds", ["", "now", "1.5", "1e9", "-1", "1" * 40])
def test_invalid_dates_are_refused(monkeypatch: pytest.MonkeyPatch, seconds: str) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", seconds)
    with pytest.raises(BuildError, match=f"SOURCE_DATE_EPOCH = '{seconds}' refused: must be"):
        date_of_build()
