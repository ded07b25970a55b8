"""modelDescription.xml of FMI 3.0, from the table of variables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.etree import ElementTree as ET

from fmu_src import __version__
from fmu_src.model_description import (
    DESCRIPTION,
    LOG_CATEGORIES,
    add_units,
    checked_dependencies,
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
            "description": about,
            "author": "slider-resonator contributors",
            "version": __version__,
            "license": "MIT",
            "generationTool": generation_tool,
            "generationDateAndTime": generated,
            "variableNamingConvention": "flat",
        },
    )
    capabilities = {name: str(value).lower() for name, value in _CAPABILITIES.items()}
    ET.SubElement(root, "CoSimulation", {"modelIdentifier": model, **capabilities})
    add_units(root, variables)
    categories = ET.SubElement(root, "LogCategories")
    for name, text in LOG_CATEGORIES.items():
        described = text.replace("fmi2", "fmi3")
        ET.SubElement(categories, "Category", {"name": name, "description": described})
    ET.SubElement(
        root, "DefaultExperiment", {"startTime": "0.0", "stopTime": "0.2", "stepSize": "0.001"}
    )
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
        _add_variable(model_variables, reference, variable)
    _add_structure(root, variables)
    return xml_bytes(root)


def _add_variable(parent: ET.Element, reference: int, variable: Variable) -> None:
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": variable.description,
        "causality": variable.causality,
        "variability": variable.variability,
    }
    if variable.causality != "input":
        attributes["initial"] = "calculated" if variable.causality == "output" else "exact"
    number = int if variable.type == "Integer" else float
    values = {
        "min": variable.minimum,
        "max": variable.maximum,
        "nominal": variable.nominal,
        "start": variable.start,
    }
    details = {"unit": variable.unit, "displayUnit": variable.display_unit}
    # repr gives the shortest text that reads back as the same number.
    details |= {k: None if x is None else repr(number(x)) for k, x in values.items()}
    given = {k: x for k, x in details.items() if x is not None}
    ET.SubElement(parent, TYPES[variable.type], attributes | given)


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
