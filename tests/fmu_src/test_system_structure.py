from xml.etree import ElementTree as ET

import pytest

from fmu_src.python.slider_component.variable import Variable
from fmu_src.system_structure import Connection, ParameterValues, System, parameter_set, structure

SSD = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
SSC = "{http://ssp-standard.org/SSP1/SystemStructureCommon}"
SSV = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"

FORCE = Variable("force", "", "Real", "input", "continuous", 0.0, "N")
IDLE = Variable("idle", "", "Real", "input", "continuous", 0.0, "N")
SPEED = Variable("speed", "", "Real", "output", "continuous", unit="m/s")
STAGES = Variable("stages", "", "Integer", "parameter", "fixed", 1)
GAIN = Variable("gain", "", "Real", "parameter", "fixed", 1.0)
SYSTEM = System(
    "Drive",
    "A motor",
    {"motor": "resources/Motor.fmu"},
    {"motor": (FORCE, IDLE, SPEED, STAGES, GAIN)},
    (Connection("push", "motor.force"), Connection("motor.speed", "speed")),
    1.5,
)
FAST = ParameterValues("fast", {"motor.stages": 2, "motor.gain": 0.1 + 0.2})


def drive(*, connectors: bool) -> bytes:
    return structure(SYSTEM, source="resources/fast.ssv", parameters=FAST, connectors=connectors)


def found(element: ET.Element, path: str) -> ET.Element:
    child = element.find(path)
    assert child is not None, f"{path} is missing"
    return child


def connectors(element: ET.Element) -> dict[str, tuple[str, str]]:
    return {
        c.attrib["name"]: (c.attrib["kind"], found(c, f"{SSC}Real").attrib["unit"])
        for c in element.iterfind(f"{SSD}Connectors/{SSD}Connector")
    }


def test_connections_are_dropped_with_their_connectors() -> None:
    system = found(ET.fromstring(drive(connectors=False)), f"{SSD}System")
    assert connectors(system) == {}
    component = found(system, f"{SSD}Elements/{SSD}Component")
    assert connectors(component) == {"speed": ("output", "m/s")}, "fmpy sets listed inputs to 0"
    assert system.findall(f"{SSD}Connections/{SSD}Connection") == []


def test_parameters_have_their_type_and_unit() -> None:
    alone = ET.fromstring(parameter_set(SYSTEM, FAST))
    inside = found(ET.fromstring(drive(connectors=False)), f".//{SSV}ParameterSet")
    for root, prefix in ((alone, "motor."), (inside, "")):
        stages, gain = root.iterfind(f"{SSV}Parameters/{SSV}Parameter")
        assert [stages.attrib["name"], gain.attrib["name"]] == [f"{prefix}stages", f"{prefix}gain"]
        assert found(stages, f"{SSV}Integer").attrib == {"value": "2"}
        assert found(gain, f"{SSV}Real").attrib == {"value": "0.30000000000000004", "unit": "1"}


def test_a_connection_to_nothing_is_an_error() -> None:
    with pytest.raises(KeyError, match="torque"):
        parameter_set(SYSTEM, ParameterValues("fast", {"motor.torque": 1.0}))
