"""The native FMU of FMI 3.0: order of calls, values, refusals, its description, and scenes."""

import ctypes
import math
from pathlib import Path
from typing import Any

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import fmi3Error, fmi3InstanceEnvironment, fmi3LogMessageCallback, fmi3OK
from lxml import etree

from fmu_src.python.slider_component.variables import VARIABLES
from slider_resonator.checks.validate import validate
from slider_resonator.scenes.scene_files import find_scene
from studies.mutants.archive import files_in
from tests.fmu.host import Unpacked
from tests.fmu.host_3 import Instance3, instance_3
from tests.fmu.native_calls import call, check

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
STEP = 1e-3
TIME = 1
NOT_OFFERED = (
    *("ActivateModelPartition", "CompletedIntegratorStep", "EnterConfigurationMode"),
    *("EnterContinuousTimeMode", "EvaluateDiscreteStates", "ExitConfigurationMode"),
    *("GetAdjointDerivative", "GetContinuousStateDerivatives", "GetContinuousStates"),
    *("GetDirectionalDerivative", "GetEventIndicators", "GetIntervalDecimal"),
    *("GetIntervalFraction", "GetNominalsOfContinuousStates", "GetNumberOfContinuousStates"),
    *("GetNumberOfEventIndicators", "GetNumberOfVariableDependencies", "GetOutputDerivatives"),
    *("GetShiftDecimal", "GetShiftFraction", "GetVariableDependencies", "SetContinuousStates"),
    *("SetIntervalDecimal", "SetIntervalFraction", "SetShiftDecimal", "SetShiftFraction"),
    "SetTime",
)
OTHER_TYPES = (
    *("Float32", "Int8", "UInt8", "Int16", "UInt16", "UInt32", "Int64", "UInt64"),
    *("Boolean", "String"),
)


@pytest.fixture
def instance(unpacked_3: Unpacked) -> Any:
    """An initialized instance in step mode, whose steps end at events."""
    with instance_3(unpacked_3) as made:
        yield made.initialize()


@pytest.mark.parametrize("name", NOT_OFFERED)
def test_what_is_not_offered_says_so(instance: Instance3, name: str) -> None:
    with instance.refuses(f"fmi3{name} refused"):
        check(call(instance, f"fmi3{name}", *[ctypes.c_void_p()] * 8))


@pytest.mark.parametrize(
    ("kind", "wrong", "text"),
    [
        *(
            (kind, {}, f"fmi3Instantiate{kind} refused: this FMU is for co-simulation")
            for kind in ("ModelExchange", "ScheduledExecution")
        ),
        ("CoSimulation", {"token": b"another"}, "instantiationToken = 'another' refused"),
        ("CoSimulation", {"name": b""}, "instanceName refused: it is empty"),
        ("CoSimulation", {"required": 1}, "nRequiredIntermediateVariables = 1 refused"),
    ],
)
def test_instantiation_is_refused(
    instance: Instance3, kind: str, wrong: dict[str, Any], text: str
) -> None:
    """Called by ctypes: the slave of older versions of fmpy asks for no intermediate variables."""
    said: list[str] = []
    logger = fmi3LogMessageCallback(lambda _, status, category, text: said.append(text.decode()))
    instantiate = instance.slave.dll[f"fmi3Instantiate{kind}"]
    instantiate.restype = ctypes.c_void_p
    given = {"name": b"x", "token": instance.slave.guid.encode(), "required": 0} | wrong
    arguments = [given["name"], given["token"], None, False, False]
    if kind == "CoSimulation":
        required = (ctypes.c_uint32 * 1)(TIME), ctypes.c_size_t(given["required"])
        arguments += [False, False, *required]
    callbacks = [ctypes.c_void_p()] * {"ModelExchange": 0, "CoSimulation": 1}.get(kind, 3)
    assert instantiate(*arguments, fmi3InstanceEnvironment(), logger, *callbacks) is None
    (message,) = said
    assert text in message


def test_time_is_read_and_not_set(instance: Instance3) -> None:
    assert instance.get("load", "time", "phase") == (0.0, 0.0, 0.0)
    instance.step_to(STEP)
    assert instance.get("time") == (STEP,)
    with instance.refuses("time (valueReference = 1) refused: it is the independent variable"):
        instance.slave.setFloat64([TIME], [0.0])
    with instance.refuses("time (valueReference = 1) refused: its type is Float64, not Int32"):
        instance.slave.getInt32([TIME])


@pytest.mark.parametrize("reference", [0, len(VARIABLES) + 2, 2**32 - 1])
def test_an_unknown_reference_is_refused(instance: Instance3, reference: int) -> None:
    last = len(VARIABLES) + 1
    text = f"valueReference = {reference} refused: must be from 1 to {last}"
    with instance.refuses(text):
        instance.slave.getFloat64([reference])


def test_more_references_than_variables_are_refused(instance: Instance3) -> None:
    """With the time one more may be read than there are variables, but no other one twice."""
    position = instance.reference("position")
    some = [position] * len(VARIABLES)
    assert len(instance.slave.getFloat64([TIME, *some])) == len(VARIABLES) + 1
    with pytest.raises(FMICallException):
        instance.slave.getFloat64([position, *some])
    refused = f"nValueReferences = {len(VARIABLES) + 1} refused: must be at most"
    assert refused in instance.log[-1]


@pytest.mark.parametrize("type_name", OTHER_TYPES)
def test_there_are_no_variables_of_other_types(instance: Instance3, type_name: str) -> None:
    with instance.refuses(f"its type is Float64, not {type_name}"):
        getattr(instance.slave, f"get{type_name}")([instance.reference("load")])
    assert call(instance, f"fmi3Get{type_name}", None, 0, None, 0) == fmi3OK
    assert call(instance, f"fmi3Set{type_name}", None, 0, None, 0) == fmi3OK


def test_null_pointers_are_refused(instance: Instance3) -> None:
    step, zero = ctypes.c_double(STEP), ctypes.c_double(0.0)
    nothing = [ctypes.c_void_p()] * 4
    assert call(instance, "fmi3DoStep", zero, step, ctypes.c_bool(True), *nothing) == fmi3Error
    assert "fmi3DoStep: a null pointer refused" in instance.log[-1]
    assert call(instance, "fmi3GetFloat64", None, 1, None, 1) == 3
    assert call(instance, "fmi3GetFMUState", None) == fmi3Error
    assert "null pointer" in instance.log[-1]
    assert instance.slave.dll.fmi3Reset(None) == fmi3Error
    many = (ctypes.c_uint32 * 1)(2)
    value = (ctypes.c_double * 2)()
    assert call(instance, "fmi3GetFloat64", many, 1, value, 2) == fmi3Error
    assert "nValues = 2 refused: must be 1" in instance.log[-1]


def test_calls_out_of_order_are_refused(unpacked_3: Unpacked) -> None:
    """The scene `interface` tries others, and event mode without announcement."""
    with instance_3(unpacked_3) as instance:
        instance.slave.enterInitializationMode()
        with instance.refuses("enterInitializationMode refused in state 'initialization mode'"):
            instance.slave.enterInitializationMode()
        instance.slave.exitInitializationMode()
        with instance.refuses("doStep refused in state 'event mode'"):
            instance.slave.doStep(0.0, STEP)
        with instance.refuses("enterEventMode refused in state 'event mode'"):
            instance.slave.enterEventMode()
        instance.handle_event(enter=False)
        with instance.refuses("updateDiscreteStates refused in state 'step mode'"):
            instance.slave.updateDiscreteStates()
    with instance_3(unpacked_3, event_mode=False) as instance:
        instance.initialize()
        with instance.refuses("fmi3EnterEventMode refused: eventModeUsed = false"):
            instance.slave.enterEventMode()


def test_a_state_in_event_mode_goes_on_without_that_mode(unpacked_3: Unpacked) -> None:
    with instance_3(unpacked_3) as one, instance_3(unpacked_3, event_mode=False) as other:
        one.initialize()
        one.slave.enterEventMode()
        other.initialize()
        other.restore(one.state())
        other.step_to(STEP)
        one.slave.enterStepMode()
        one.step_to(STEP)
        assert other.get("position", "velocity") == one.get("position", "velocity")


def test_debug_logging_selects_categories(instance: Instance3) -> None:
    instance.slave.setDebugLogging(False, [])
    with pytest.raises(FMICallException):
        instance.set(load=math.nan)
    assert instance.log == []
    with pytest.raises(FMICallException):
        instance.slave.setDebugLogging(True, ["noise"])
    instance.slave.setDebugLogging(True, ["logStatusError"])
    with instance.refuses("fmi3SetDebugLogging: category 'noise' refused: must be one of"):
        instance.slave.setDebugLogging(True, ["noise"])
    assert instance.entries[-1][1:3] == (fmi3Error, "logStatusError")


def test_capabilities(unpacked_3: Unpacked) -> None:
    simulation = unpacked_3.description.coSimulation
    assert simulation.hasEventMode
    assert simulation.canHandleVariableCommunicationStepSize
    assert simulation.canGetAndSetFMUstate
    assert simulation.canSerializeFMUstate
    assert not simulation.canReturnEarlyAfterIntermediateUpdate
    assert not simulation.providesIntermediateUpdate
    assert not simulation.needsExecutionTool
    assert unpacked_3.description.modelExchange is None


def test_the_flange_names_variables(native_3_fmu: Path, unpacked_3: Unpacked) -> None:
    """In a document that fmpy's validation does not read."""
    root = etree.fromstring(files_in(native_3_fmu)["terminalsAndIcons/terminalsAndIcons.xml"])
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(root)
    members = [m.get("variableName") for m in root.iter("TerminalMemberVariable")]
    assert members == ["position", "velocity", "load"]
    assert set(members) < {v.name for v in unpacked_3.description.modelVariables}


@pytest.mark.isolated  # some scenes judge what an FMU does to its process
@pytest.mark.parametrize("name", ["interface", "changing_inputs", "tuned", "burst"])
def test_scene_passes(native_3_fmu: Path, name: str) -> None:
    (result,) = validate([native_3_fmu], [find_scene(name)])
    assert not result.run_failures
    failed = [(c.quantity, c.fmu, c.reference) for c in result.checks if not c.passed]
    assert not failed, "FMI 3.0 is another shell around the same component"
