"""FMI functions of the native FMU called as no careful host does."""

import ctypes
import math
from typing import Any

import pytest

from fmu_src.python.slider_component.variables import VALUE_REFERENCE, VARIABLES
from tests.fmu.host import HostMemory, Instance, Unpacked
from tests.fmu.native_calls import DISCARD, ERROR, OK, call, check, reals, references
from tests.fmu.test_native_binaries import fmi_functions
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

NULL = ctypes.c_void_p()
NOT_OFFERED = (
    *("EnterEventMode", "NewDiscreteStates", "EnterContinuousTimeMode", "CompletedIntegratorStep"),
    *("SetTime", "SetContinuousStates", "GetDerivatives", "GetEventIndicators", "CancelStep"),
    *("GetContinuousStates", "GetNominalsOfContinuousStates", "GetDirectionalDerivative"),
)


@pytest.mark.parametrize(
    ("wrong", "text"),
    [
        ({"guid": b"{not-this-build}"}, "fmuGUID = '{not-this-build}' refused: must be '"),
        ({"kind": 0}, "fmuType = 0 refused: must be 1, fmi2CoSimulation"),
        ({"name": b""}, "instanceName refused: it is empty"),
        ({"name": None}, "instanceName refused: it is a null pointer"),
    ],
    ids=["guid", "type", "empty name", "no name"],
)
def test_a_refused_instantiation_says_why(
    unpacked: Unpacked, wrong: dict[str, Any], text: str
) -> None:
    """Also when no logging is asked for. It takes no memory."""
    memory = HostMemory()
    instance = Instance(unpacked, memory=memory)
    slave, in_use = instance.slave, memory.in_use
    given = {"name": b"slider", "kind": 1, "guid": slave.guid.encode()} | wrong
    callbacks = ctypes.byref(slave.callbacks)
    assert slave.fmi2Instantiate(*given.values(), None, callbacks, 0, 0) is None
    assert memory.in_use == in_use
    (entry,) = instance.entries
    assert (entry.status, entry.category) == (ERROR, "logStatusError")
    assert text in entry.text
    instance.free()


@pytest.mark.parametrize(
    "missing", [("allocateMemory",), ("freeMemory",), ("allocateMemory", "freeMemory", "logger")]
)
def test_a_host_without_memory_callbacks_is_served(
    unpacked: Unpacked, missing: tuple[str, ...]
) -> None:
    memory = HostMemory()
    Instance(unpacked, memory=memory, missing=missing).free()
    assert memory.given == 0, "memory from one is never given to another"


def test_a_host_that_runs_out_of_memory_gets_no_state(unpacked: Unpacked) -> None:
    memory, state = HostMemory(), ctypes.c_void_p()
    instance = Instance(unpacked, memory=memory)
    memory.limit = 0
    assert call(instance, "fmi2GetFMUstate", ctypes.byref(state)) == ERROR
    assert state.value is None
    assert instance.log[-1] == "fmi2GetFMUstate: no memory for a state"
    memory.limit = math.inf
    assert call(instance, "fmi2GetFMUstate", ctypes.byref(state)) == OK, "it can go on"
    assert call(instance, "fmi2FreeFMUstate", ctypes.byref(state)) == OK
    instance.free()
    assert memory.given > 0 == memory.in_use


OF_NO_INSTANCE = {"fmi2Instantiate", "fmi2GetVersion", "fmi2GetTypesPlatform", "fmi2FreeInstance"}
"""The scene `interface` calls those with and without instances."""


@pytest.mark.parametrize("function", sorted(fmi_functions() - OF_NO_INSTANCE))
def test_no_instance_is_an_error_and_no_crash(instance: Instance, function: str) -> None:
    assert instance.slave.dll[function](*[NULL] * 8) == ERROR


@pytest.mark.parametrize("function", NOT_OFFERED)
def test_what_is_not_offered_is_refused_by_name(instance: Instance, function: str) -> None:
    with instance.refuses(f"fmi2{function} refused"):
        check(call(instance, f"fmi2{function}", *[NULL] * 6))


TYPES = ("Real", "Integer", "Boolean", "String")
ARRAYS = {
    **{f"fmi2{verb}{name}": 1 for verb in ("Get", "Set") for name in TYPES},
    **{"fmi2SetRealInputDerivatives": 2, "fmi2GetRealOutputDerivatives": 2},
}
"""Functions that take references, their number, and arrays."""


@pytest.mark.parametrize("function", ARRAYS)
def test_null_pointers_and_huge_counts_are_refused(instance: Instance, function: str) -> None:
    vr, *arrays = given = [references([0] * 37), *[reals([0.0] * 37)] * ARRAYS[function]]
    for place in range(len(given)):
        first, *rest = [NULL if i == place else array for i, array in enumerate(given)]
        assert call(instance, function, first, 37, *rest) == ERROR
        assert f"{function}: a null pointer refused" in instance.log[-1]
    for count in (len(VARIABLES) + 1, 2**31, 2**64 - 1):
        assert call(instance, function, vr, count, *arrays) == ERROR
        assert f"{function}: nvr = " in instance.log[-1]
        assert f"must be at most {len(VARIABLES)}" in instance.log[-1]
    nothing = [NULL] * ARRAYS[function]
    assert call(instance, function, NULL, 0, *nothing) == OK, "nothing asked, nothing refused"


def test_a_refused_get_writes_nothing(instance: Instance) -> None:
    values = reals([7.0, 7.0])
    known = VALUE_REFERENCE["load"]
    assert call(instance, "fmi2GetReal", references([known, 999]), 2, values) == ERROR
    assert list(values) == [7.0, 7.0]


def test_a_reset_forgets_the_status_of_the_last_step(instance: Instance) -> None:
    """Scenes ask for it after steps that are refused."""
    value = ctypes.c_int(-1)
    assert call(instance, "fmi2DoStep", ctypes.c_double(0.5), ctypes.c_double(0.01)) == ERROR
    instance.slave.reset()
    assert call(instance, "fmi2GetStatus", ctypes.c_int(0), ctypes.byref(value)) == OK
    assert value.value == OK


@pytest.mark.parametrize(
    ("function", "known"), {"": 0, "Real": 2, "Boolean": 3, "Integer": None, "String": None}.items()
)
def test_a_status_that_is_not_known_is_discarded(
    instance: Instance, function: str, known: int | None
) -> None:
    name, place = f"fmi2Get{function}Status", ctypes.create_string_buffer(b"\x07" * 8, 8)
    for kind in (-1, 0, 1, 2, 3, 99):
        expected = OK if kind == known else DISCARD
        assert call(instance, name, ctypes.c_int(kind), place) == expected, kind
        assert call(instance, name, ctypes.c_int(kind), NULL) == ERROR
    if known is None:
        assert place.raw == b"\x07" * 8, "nothing was written"


def debug_logging(instance: Instance, logging_on: bool, *categories: str | None) -> int:
    names = [None if c is None else c.encode() for c in categories]
    array = (ctypes.c_char_p * len(names))(*names)
    return call(instance, "fmi2SetDebugLogging", ctypes.c_int(logging_on), len(names), array)


def messages_of(instance: Instance) -> int:
    """Messages that an error and an unknown status give."""
    before, nowhen, number = len(instance.log), ctypes.c_double(math.nan), ctypes.c_int()
    assert call(instance, "fmi2DoStep", ctypes.c_double(0.0), nowhen) == ERROR
    pending = call(instance, "fmi2GetIntegerStatus", ctypes.c_int(0), ctypes.byref(number))
    assert pending == DISCARD
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


@pytest.mark.parametrize("category", ["logEverything", "", None, "100%d#r1#" * 50])
def test_unknown_log_category_is_refused(instance: Instance, category: str | None) -> None:
    assert debug_logging(instance, True, "logStatusError") == OK
    assert debug_logging(instance, True, "logStatusDiscard", category) == ERROR
    shown = "(null)" if category is None else category.replace("%", "%%").replace("#", "##")[:20]
    assert f"category '{shown}" in instance.log[-1], "the logger takes % and # doubled"
    assert "must be one of logStatusWarning, logStatusDiscard" in instance.log[-1]
    assert messages_of(instance) == 1


def test_invalid_category_counts_are_refused(instance: Instance) -> None:
    for count, status in ((10**9, ERROR), (2, ERROR), (0, OK)):
        assert call(instance, "fmi2SetDebugLogging", ctypes.c_int(1), count, NULL) == status
    assert "nCategories = 1000000000 refused" in instance.log[0]


@pytest.mark.parametrize("logging_on", [False, True])
def test_errors_are_sent_without_debug_logging(
    unpacked: Unpacked, capfd: pytest.CaptureFixture[str], logging_on: bool
) -> None:
    instance = Instance(unpacked, logging_on=logging_on).initialize()
    sent = messages_of(instance)
    expected = [("slider", ERROR, "logStatusError"), ("slider", DISCARD, "logStatusDiscard")]
    found = [(entry.instance, entry.status, entry.category) for entry in instance.entries]
    assert found == expected[:sent]
    assert sent == (2 if logging_on else 1)
    assert "communicationStepSize = nan refused" in instance.log[0]
    instance.free()
    assert capfd.readouterr() == ("", ""), "the streams belong to the host"
