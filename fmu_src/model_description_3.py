"""modelDescription.xml of FMI 3.0, from the table of variables."""

from collections.abc import Iterable, Sequence
from xml.etree import ElementTree as ET

from fmu_src.model_description import (
    DESCRIPTION,
    add_definitions,
    checked_dependencies,
    identity,
    numbers,
    origin,
)
from fmu_src.python.slider_component.variable import Variable
from fmu_src.python.slider_component.variables import VARIABLES
from fmu_src.xml_text import xml_bytes

TIME_REFERENCE = 1
"""Value reference of the time; 0 makes hosts fail that take it for no reference."""

REFERENCE_OFFSET = 2
"""Value reference of the first row of the table."""

TYPES = {"Real": "Float64", "Integer": "Int32"}
"""Type in the table to type of FMI 3.0."""

_CAPABILITIES: dict[str, bool] = {
    "needsExecutionTool": False,
    "canBeInstantiatedOnlyOncePerProcess": False,
    "canGetAndSetFMUState": True,
    "canSerializeFMUState": True,
    "canHandleVariableCommunicationStepSize": True,
    "mightReturnEarlyFromDoStep": True,
    "canReturnEarlyAfterIntermediateUpdate": False,
    "hasEventMode": True,
    "providesEvaluateDiscreteStates": False,
}


def model_description_3(
    *,
    model: str,
    guid: str,
    generation_tool: str,
    generated: str,
    about: str = DESCRIPTION,
    variables: Sequence[Variable] = VARIABLES,
) -> bytes:
    """Return the model description as UTF-8 bytes; equal arguments give equal bytes.

    The arguments are those of `model_description`. The value reference of a variable is its
    position in `variables` plus REFERENCE_OFFSET. Raises ValueError as `model_description` does.
    """
    root = ET.Element(
        "fmiModelDescription",
        {
            "fmiVersion": "3.0",
            "modelName": model,
            "instantiationToken": guid,
            **origin(about, generation_tool, generated),
        },
    )
    capabilities = {name: str(value).lower() for name, value in _CAPABILITIES.items()}
    ET.SubElement(root, "CoSimulation", {"modelIdentifier": model, **capabilities})
    add_definitions(root, variables, "fmi3")
    model_variables = ET.SubElement(root, "ModelVariables")
    ET.SubElement(
        model_variables,
        "Float64",
        {
            "name": "time",
            "valueReference": str(TIME_REFERENCE),
            "description": "Present time of the component",
            "causality": "independent",
            "variability": "continuous",
            "unit": "s",
        },
    )
    for reference, variable in enumerate(variables, start=REFERENCE_OFFSET):
        attributes = identity(reference, variable) | numbers(variable)
        ET.SubElement(model_variables, TYPES[variable.type], attributes)
    _add_structure(root, variables)
    return xml_bytes(root)


def _add_structure(root: ET.Element, variables: Sequence[Variable]) -> None:
    outputs = [v for v in variables if v.causality == "output"]
    inputs = {v.name for v in variables if v.causality == "input"}
    known_at_start = inputs | {v.name for v in variables if v.causality == "parameter"}
    references = {v.name: i for i, v in enumerate(variables, start=REFERENCE_OFFSET)}
    structure = ET.SubElement(root, "ModelStructure")

    def add(tag: str, output: str, dependencies: Iterable[str], known: set[str]) -> None:
        names = checked_dependencies(output, dependencies, known)
        found = sorted(references[name] for name in names)
        ET.SubElement(
            structure,
            tag,
            {
                "valueReference": str(references[output]),
                "dependencies": " ".join(map(str, found)),
                "dependenciesKind": " ".join("dependent" for _ in found),
            },
        )

    for v in outputs:
        add("Output", v.name, v.depends_on, inputs)
    for v in outputs:
        add("InitialUnknown", v.name, v.depends_initially_on, known_at_start)
