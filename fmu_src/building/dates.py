"""The date in a model description: SOURCE_DATE_EPOCH, never the time of the build."""

import os
from datetime import UTC, datetime

from fmu_src.building.build_error import BuildError

EPOCH = datetime(1980, 1, 1, tzinfo=UTC)
"""The earliest time in a zip archive."""


def date_of_build() -> datetime:
    """Return SOURCE_DATE_EPOCH (seconds since 1970-01-01), by default EPOCH. Raises BuildError."""
    seconds = os.environ.get("SOURCE_DATE_EPOCH")
    if seconds is None:
        return EPOCH
    try:
        if int(seconds) < 0:
            raise ValueError(seconds)
        return datetime.fromtimestamp(int(seconds), UTC)
    except (ValueError, OverflowError, OSError):
        raise BuildError(
            f"SOURCE_DATE_EPOCH = {seconds!r} refused: must be a whole number of seconds since "
            "1970-01-01, at least 0"
        ) from None


def date_text(date: datetime) -> str:
    """Return the date in FMI's notation."""
    return date.strftime("%Y-%m-%dT%H:%M:%SZ")
