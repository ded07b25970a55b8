"""Messages of the native FMU: which ones are sent, with what category, and to whom."""

from __future__ import annotations

import ctypes
import math
from pathlib import Path

import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException

from fmu_src.model_description import LOG_CATEGORIES
from tests.fmu.host import Instance, Unpacked
from tests.fmu.native_calls import DISCARD, ERROR, OK, call
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only


def debug_logging(instance: Instance, logging_on: bool, *categories: str | None) -> int:
    names = [None if c is None else c.encode() for c in categories]
    array = (ctypes.c_char_p * len(names))(*names)
    return call(instance, "fmi2SetDebugLogging", ctypes.c_int(logging_on), len(names), array)


def provoke_error(instance: Instance) -> int:
    return call(instance, "fmi2DoStep", ctypes.c_double(0.0), ctypes.c_double(math.nan))


def provoke_discard(instance: Instance) -> int:
    return call(instance, "fmi2GetIntegerStatus", ctypes.c_int(0), ctypes.byref(ctypes.c_int()))


def messages_of(instance: Instance) -> int:
    """Messages that an error and an unknown status give."""
    before = len(instance.log)
    assert provoke_error(instance) == ERROR
    assert provoke_discard(instance) == DISCARD
    return len(instance.log) - before


@pytest.mark.parametrize(
    ("categories", "sent"),
    [
        ((), 2),
        (("logAll",), 2),
        (("logStatusError",), 1),
        (("logStatusDiscard",), 1),
        (("logStatusDiscard", "logStatusError"), 2),
        (("logStatusWarning", "logStatusFatal"), 0),
    ],
)
def test_only_wanted_categories_are_sent(
    instance: Instance, categories: tuple[str, ...], sent: int
) -> None:
    assert debug_logging(instance, True, *categories) == OK
    assert messages_of(instance) == sent
    assert debug_logging(instance, False, *categories) == OK
    assert messages_of(instance) == 0, "logging is off"
    assert debug_logging(instance, True) == OK
    assert messages_of(instance) == 2


@pytest.mark.parametrize("category", LOG_CATEGORIES)
def test_every_category_of_the_description_is_known(instance: Instance, category: str) -> None:
    assert debug_logging(instance, True, category) == OK


@pytest.mark.parametrize("category", ["logEverything", "", None, "100%d#r1#" * 50])
def test_unknown_log_category_is_refused(instance: Instance, category: str | None) -> None:
    assert debug_logging(instance, True, "logStatusError") == OK
    assert debug_logging(instance, True, "logStatusDiscard", category) == ERROR
    shown = "(null)" if category is None else category.replace("%", "%%").replace("#", "##")[:20]
    assert f"category '{shown}" in instance.log[-1], "the logger takes % and # doubled"
    assert "must be one of logStatusWarning, logStatusDiscard" in instance.log[-1]
    assert messages_of(instance) == 1


def test_invalid_category_counts_are_refused(instance: Instance) -> None:
    null = ctypes.c_void_p()
    assert call(instance, "fmi2SetDebugLogging", ctypes.c_int(1), 10**9, null) == ERROR
    assert "nCategories = 1000000000 refused" in instance.log[-1]
    assert call(instance, "fmi2SetDebugLogging", ctypes.c_int(1), 2, null) == ERROR
    assert call(instance, "fmi2SetDebugLogging", ctypes.c_int(1), 0, null) == OK


@pytest.mark.parametrize("logging_on", [False, True])
def test_errors_are_sent_without_debug_logging(
    unpacked: Unpacked, capfd: pytest.CaptureFixture[str], logging_on: bool
) -> None:
    instance = Instance(unpacked, logging_on=logging_on).initialize()
    assert provoke_error(instance) == ERROR
    assert provoke_discard(instance) == DISCARD
    expected = [("slider", ERROR, "logStatusError"), ("slider", DISCARD, "logStatusDiscard")]
    found = [(entry.instance, entry.status, entry.category) for entry in instance.entries]
    assert found == (expected if logging_on else expected[:1])
    assert "communicationStepSize = nan refused" in instance.log[0]
    instance.free()
    assert capfd.readouterr() == ("", ""), "the streams belong to the host"


def test_a_host_may_turn_errors_off(unpacked: Unpacked) -> None:
    instance = Instance(unpacked, logging_on=False).initialize()
    assert debug_logging(instance, False) == OK
    assert messages_of(instance) == 0
    assert debug_logging(instance, True, "logStatusError") == OK
    assert messages_of(instance) == 1
    instance.free()


def test_fmpy_says_why_a_run_failed(fmu: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """With all defaults: its own logger prints what the FMU sends."""
    with pytest.raises(FMICallException):
        simulate_fmu(str(fmu), start_values={"load": math.nan}, stop_time=0.1)
    assert "load = nan refused: must be a finite number" in capfd.readouterr().out
