from dataclasses import replace
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from pythonfmu import Fmi2Slave

from fmu_src.model_description import LOG_CATEGORIES, model_description
from fmu_src.python.slider_component.variables import VARIABLES


def describe(**changes: Any) -> bytes:
    given: dict[str, Any] = {"model": "SliderResonatorPy", "guid": "a-guid"}
    given |= {"generation_tool": "a tool", "generated": "1980-01-01T00:00:00Z"}
    return model_description(**(given | {"host_manages_memory": False} | changes))


@pytest.mark.parametrize("host_manages_memory", [True, False])
@pytest.mark.parametrize("takes_derivatives", [True, False])
def test_capabilities(host_manages_memory: bool, takes_derivatives: bool) -> None:
    given = {"host_manages_memory": host_manages_memory, "takes_derivatives": takes_derivatives}
    (simulation,) = ET.fromstring(describe(**given)).iterfind("CoSimulation")
    assert simulation.attrib == {
        "modelIdentifier": "SliderResonatorPy",
        "needsExecutionTool": "false",
        "canHandleVariableCommunicationStepSize": "true",
        "canInterpolateInputs": "true" if takes_derivatives else "false",
        "canRunAsynchronuously": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "false" if host_manages_memory else "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
        "providesDirectionalDerivative": "false",
        "maxOutputDerivativeOrder": "1" if takes_derivatives else "0",
    }


def test_log_categories_are_those_that_the_binary_uses() -> None:
    root = ET.fromstring(describe())
    names = [e.attrib["name"] for e in root.iterfind("LogCategories/Category")]
    assert names == list(LOG_CATEGORIES) == list(Fmi2Slave.log_categories)


@pytest.mark.parametrize(
    ("name", "changes", "text"),
    [
        ("load", {"unit": "lbf"}, "load: unit 'lbf' is not defined"),
        ("load", {"display_unit": "kN"}, "load: unit 'N' has no display unit 'kN'; it has mN"),
        ("position", {"depends_initially_on": ("velocity",)}, "position cannot depend on velocity"),
    ],
    ids=["unit", "display unit", "dependency"],
)
def test_a_broken_table_is_refused_by_name(name: str, changes: dict[str, Any], text: str) -> None:
    table = [replace(v, **changes) if v.name == name else v for v in VARIABLES]
    with pytest.raises(ValueError, match=text):
        describe(variables=table)
