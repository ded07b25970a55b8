"""FMI functions of the native FMU called as no careful host does."""

import ctypes
import math
from dataclasses import dataclass, field
from typing import Any

import pytest
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

from fmu_src.python.slider_component.variables import VALUE_REFERENCE, VARIABLES
from tests.fmu.host import HostMemory, Instance, Unpacked
from tests.fmu.native_calls import DISCARD, ERROR, OK, call, reals, references
from tests.fmu.test_native_binaries import fmi_functions
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

NULL = ctypes.c_void_p()
NOT_OFFERED = (
    "EnterEventMode",
    "NewDiscreteStates",
    "EnterContinuousTimeMode",
    "CompletedIntegratorStep",
    "SetTime",
    "SetContinuousStates",
    "GetDerivatives",
    "GetEventIndicators",
    "GetContinuousStates",
    "GetNominalsOfContinuousStates",
    "CancelStep",
    "GetDirectionalDerivative",
)


@dataclass
class Host(HostMemory):
    """A host that keeps what is logged; the callbacks called `missing` are null."""

    missing: tuple[str, ...] = ()
    log: list[tuple[bytes, int, bytes, bytes]] = field(default_factory=list)
    kept: list[fmi2CallbackFunctions] = field(default_factory=list)

    def callbacks(self) -> fmi2CallbackFunctions:
        functions = {
            "logger": fmi2CallbackLoggerTYPE(lambda _, *said: self.log.append(said)),
            "allocateMemory": fmi2CallbackAllocateMemoryTYPE(self.allocate),
            "freeMemory": fmi2CallbackFreeMemoryTYPE(self.release),
        }
        present = {k: f for k, f in functions.items() if k not in self.missing}
        self.kept.append(fmi2CallbackFunctions(**present))
        return self.kept[-1]


def instantiate_as(
    instance: Instance,
    host: Host,
    guid: str | None = None,
    name: bytes | None = b"slider",
    kind: int = 1,
) -> int | None:
    """The component that fmi2Instantiate makes; its own GUID unless another is given."""
    function = instance.slave.dll.fmi2Instantiate
    function.restype = ctypes.c_void_p
    guid, callbacks = guid or instance.slave.guid, ctypes.byref(host.callbacks())
    made: int | None = function(name, ctypes.c_int(kind), guid.encode(), None, callbacks, 0, 0)
    return made


def give_back(instance: Instance, component: int | None) -> None:
    instance.slave.dll.fmi2FreeInstance(ctypes.c_void_p(component))


@pytest.mark.parametrize(
    ("wrong", "text"),
    [
        ({"guid": "{not-this-build}"}, "fmuGUID = '{not-this-build}' refused: must be '"),
        ({"kind": 0}, "fmuType = 0 refused: must be 1, fmi2CoSimulation"),
        ({"name": b""}, "instanceName refused: it is empty"),
        ({"name": None}, "instanceName refused: it is a null pointer"),
    ],
    ids=["guid", "type", "empty name", "no name"],
)
def test_a_refused_instantiation_says_why(
    instance: Instance, wrong: dict[str, Any], text: str
) -> None:
    host = Host()
    assert instantiate_as(instance, host, **wrong) is None
    ((_, status, category, said),) = host.log
    assert (status, category) == (ERROR, b"logStatusError"), "also when no logging is asked for"
    assert text in said.decode()
    assert host.in_use == 0


@pytest.mark.parametrize(
    "missing", [("allocateMemory",), ("freeMemory",), ("allocateMemory", "freeMemory", "logger")]
)
def test_a_host_without_memory_callbacks_is_served(
    instance: Instance, missing: tuple[str, ...]
) -> None:
    host = Host(missing=missing)
    component = instantiate_as(instance, host)
    assert component is not None
    give_back(instance, component)
    assert host.given == 0, "memory from one is never given to another"


def test_a_host_that_runs_out_of_memory_gets_no_state(instance: Instance) -> None:
    host = Host()
    component = instantiate_as(instance, host)
    host.limit = 0
    state = ctypes.c_void_p()
    function = instance.slave.dll.fmi2GetFMUstate
    assert function(ctypes.c_void_p(component), ctypes.byref(state)) == ERROR
    assert state.value is None
    assert host.log[-1][-1] == b"fmi2GetFMUstate: no memory for a state"
    host.limit = math.inf
    assert function(ctypes.c_void_p(component), ctypes.byref(state)) == OK, "it can go on"
    instance.slave.dll.fmi2FreeFMUstate(ctypes.c_void_p(component), ctypes.byref(state))
    give_back(instance, component)
    assert host.given > 0 == host.in_use


@pytest.mark.parametrize("function", sorted(fmi_functions() - {"fmi2Instantiate"}))
def test_no_instance_is_an_error_and_no_crash(instance: Instance, function: str) -> None:
    foreign = instance.slave.dll[function]
    if function in ("fmi2GetVersion", "fmi2GetTypesPlatform"):
        foreign.restype = ctypes.c_char_p
        assert foreign() in (b"2.0", b"default")
        return
    foreign.restype = ctypes.c_int
    status = foreign(*[ctypes.c_void_p()] * 8)
    if function != "fmi2FreeInstance":
        assert status == ERROR


@pytest.mark.parametrize("function", NOT_OFFERED)
def test_what_is_not_offered_is_refused_by_name(instance: Instance, function: str) -> None:
    before = instance.state()
    assert call(instance, f"fmi2{function}", *[NULL] * 6) == ERROR
    assert f"fmi2{function} refused" in instance.log[-1]
    assert instance.state() == before


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
    ("function", "known"),
    [("Status", 0), ("RealStatus", 2), ("BooleanStatus", 3), ("IntegerStatus", None),
     ("StringStatus", None)],
)  # fmt: skip
def test_a_status_that_is_not_known_is_discarded(
    instance: Instance, function: str, known: int | None
) -> None:
    place = ctypes.create_string_buffer(b"\x07" * 8, 8)
    for kind in (-1, 0, 1, 2, 3, 99):
        expected = OK if kind == known else DISCARD
        status = call(instance, f"fmi2Get{function}", ctypes.c_int(kind), place)
        assert status == expected, kind
        assert call(instance, f"fmi2Get{function}", ctypes.c_int(kind), NULL) == ERROR
    if known is None:
        assert place.raw == b"\x07" * 8, "nothing was written"


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
