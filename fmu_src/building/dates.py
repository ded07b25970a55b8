"""The date in a model description: that of SOURCE_DATE_EPOCH, never that of the build."""

from __future__ import annotations

import os
from datetime import UTC, datetime

from fmu_src.building.build_error import BuildError

EPOCH = datetime(1980, 1, 1, tzinfo=UTC)
"""The first moment that a zip archive can express."""


def date_of_build() -> datetime:
    """What SOURCE_DATE_EPOCH says (seconds since 1970-01-01), else EPOCH. Raises BuildError."""
    seconds = os.environ.get("SOURCE_DATE_EPOCH")
    if seconds is None:
        return EPOCH
    try:
        if int(seconds) < 0:
            raise ValueError(seconds)
        return datetime.fromtimestamp(int(seconds), UTC)
    except (ValueError, OverflowError, OSError):
        raise BuildError(
            f"SOURCE_DATE_EPOCH = {seconds!r} refused: allowed is a whole number of seconds "
            "since 1970-01-01, not below 0"
        ) from None


def date_text(date: datetime) -> str:
    """As FMI writes dates."""
    return date.strftime("%Y-%m-%dT%H:%M:%SZ")
