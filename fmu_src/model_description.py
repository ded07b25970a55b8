"""modelDescription.xml of FMI 2.0, from the table of variables."""

from collections.abc import Iterable, Sequence
from xml.etree import ElementTree as ET

from fmu_src import __version__
from fmu_src.python.slider_component.variable import Variable
from fmu_src.python.slider_component.variables import VARIABLES
from fmu_src.units import UNITS
from fmu_src.xml_text import xml_bytes

DESCRIPTION = (
    "A slider on a friction surface, moved by an embedded resonator and a normal load that varies "
    "with it"
)

# FMI's log categories by status, as far as pythonfmu knows them. It reports a refusal without a
# category: a host that asks for some categories only receives no refusals of the Python FMU.
LOG_CATEGORIES: dict[str, str] = {
    "logStatusWarning": "Messages with status fmi2Warning",
    "logStatusDiscard": "Messages with status fmi2Discard",
    "logStatusError": "Messages with status fmi2Error",
    "logStatusFatal": "Messages with status fmi2Fatal",
    "logAll": "All messages",
}

_CAPABILITIES: dict[str, bool] = {
    "needsExecutionTool": False,
    "canHandleVariableCommunicationStepSize": True,
    "canRunAsynchronuously": False,
    "canBeInstantiatedOnlyOncePerProcess": False,
    "canGetAndSetFMUstate": True,
    "canSerializeFMUstate": True,
    "providesDirectionalDerivative": False,
}


def model_description(
    *,
    model: str,
    guid: str,
    generation_tool: str,
    generated: str,
    host_manages_memory: bool,
    takes_derivatives: bool = False,
    source_files: Sequence[str] = (),
    about: str = DESCRIPTION,
    variables: Sequence[Variable] = VARIABLES,
) -> bytes:
    """Return the model description as UTF-8 bytes; equal arguments give equal bytes.

    `model` names both the model and its binaries, `generated` is the date and time of the build
    (ISO 8601, UTC), `about` describes the model in a sentence. `host_manages_memory` is True for an
    FMU that takes its memory from the host, `takes_derivatives` for one that takes first
    derivatives of inputs and gives those of outputs; `source_files` are the files to compile in its
    folder `sources`. The value reference of a variable is its position in `variables`.

    Raises ValueError for a unit that `fmu_src.units` lacks, and for a dependency on a variable that
    FMI 2.0 section 2.2.8 does not count as known.
    """
    root = ET.Element(
        "fmiModelDescription",
        {
            "fmiVersion": "2.0",
            "modelName": model,
            "guid": guid,
            **origin(about, generation_tool, generated),
        },
    )
    _add_co_simulation(root, model, host_manages_memory, takes_derivatives, source_files)
    add_definitions(root, variables, "fmi2")
    model_variables = ET.SubElement(root, "ModelVariables")
    for reference, variable in enumerate(variables):
        _add_variable(model_variables, reference, variable)
    _add_structure(root, variables)
    return xml_bytes(root)


def origin(about: str, generation_tool: str, generated: str) -> dict[str, str]:
    """Return the attributes of a description that say what it describes, and where it is from."""
    return {
        "description": about,
        "author": "slider-resonator contributors",
        "version": __version__,
        "license": "MIT",
        "generationTool": generation_tool,
        "generationDateAndTime": generated,
        "variableNamingConvention": "flat",
    }


def add_definitions(root: ET.Element, variables: Sequence[Variable], version: str) -> None:
    """Add units, log categories and the default experiment; ValueError as `add_units`.

    `version`, "fmi2" or "fmi3", is how names of the standard begin.
    """
    add_units(root, variables)
    categories = ET.SubElement(root, "LogCategories")
    for name, text in LOG_CATEGORIES.items():
        described = text.replace("fmi2", version)
        ET.SubElement(categories, "Category", {"name": name, "description": described})
    ET.SubElement(
        root, "DefaultExperiment", {"startTime": "0.0", "stopTime": "0.2", "stepSize": "0.001"}
    )


def _add_co_simulation(
    root: ET.Element,
    model: str,
    host_manages_memory: bool,
    takes_derivatives: bool,
    source_files: Sequence[str],
) -> None:
    capabilities = {
        "canNotUseMemoryManagementFunctions": not host_manages_memory,
        "canInterpolateInputs": takes_derivatives,
        **_CAPABILITIES,
    }
    attributes = {"modelIdentifier": model} | {k: str(v).lower() for k, v in capabilities.items()}
    attributes["maxOutputDerivativeOrder"] = "1" if takes_derivatives else "0"
    element = ET.SubElement(root, "CoSimulation", attributes)
    if source_files:
        files = ET.SubElement(element, "SourceFiles")
        for name in source_files:
            ET.SubElement(files, "File", {"name": name})


def add_units(root: ET.Element, variables: Sequence[Variable]) -> None:
    """Add the definitions of the units used; ValueError for one that `fmu_src.units` lacks."""
    for v in variables:
        if v.unit is not None and v.unit not in UNITS:
            raise ValueError(
                f"{v.name}: unit {v.unit!r} is not defined; defined are {', '.join(UNITS)}"
            )
        if v.display_unit is not None and v.display_unit not in UNITS[v.unit or "1"].display:
            raise ValueError(
                f"{v.name}: unit {v.unit!r} has no display unit {v.display_unit!r}; it has "
                f"{', '.join(UNITS[v.unit or '1'].display) or 'none'}"
            )
    used = {v.unit for v in variables}
    definitions = ET.SubElement(root, "UnitDefinitions")
    for name, unit in UNITS.items():
        if name in used:
            element = ET.SubElement(definitions, "Unit", {"name": name})
            ET.SubElement(element, "BaseUnit", {b: str(e) for b, e in unit.exponents.items()})
            for display, factor in unit.display.items():
                ET.SubElement(element, "DisplayUnit", {"name": display, "factor": repr(factor)})


def identity(reference: int, variable: Variable) -> dict[str, str]:
    """Return the attributes of a variable that are the same for each type."""
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": variable.description,
        "causality": variable.causality,
        "variability": variable.variability,
    }
    # FMI 2.0 table on page 49: an input has no `initial`.
    if variable.causality != "input":
        attributes["initial"] = "calculated" if variable.causality == "output" else "exact"
    return attributes


def numbers(variable: Variable) -> dict[str, str]:
    """Return the attributes of a variable that are units and values."""
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
    return {k: x for k, x in details.items() if x is not None}


def _add_variable(parent: ET.Element, reference: int, variable: Variable) -> None:
    element = ET.SubElement(parent, "ScalarVariable", identity(reference, variable))
    ET.SubElement(element, variable.type, numbers(variable))


def _add_structure(root: ET.Element, variables: Sequence[Variable]) -> None:
    outputs = [v for v in variables if v.causality == "output"]
    inputs = {v.name for v in variables if v.causality == "input"}
    known_at_start = inputs | {v.name for v in variables if v.causality == "parameter"}
    index = {v.name: i for i, v in enumerate(variables, start=1)}

    def add(section: ET.Element, output: str, dependencies: Iterable[str], known: set[str]) -> None:
        names = checked_dependencies(output, dependencies, known)
        indices = sorted(index[name] for name in names)
        ET.SubElement(
            section,
            "Unknown",
            {
                "index": str(index[output]),
                "dependencies": " ".join(map(str, indices)),
                "dependenciesKind": " ".join("dependent" for _ in indices),
            },
        )

    structure = ET.SubElement(root, "ModelStructure")
    section = ET.SubElement(structure, "Outputs")
    for v in outputs:
        add(section, v.name, v.depends_on, inputs)
    section = ET.SubElement(structure, "InitialUnknowns")
    for v in outputs:
        add(section, v.name, v.depends_initially_on, known_at_start)


def checked_dependencies(output: str, dependencies: Iterable[str], known: set[str]) -> set[str]:
    """Return the dependencies of an output; ValueError for one that is not `known`."""
    names = set(dependencies)
    if not names <= known:
        raise ValueError(
            f"{output} cannot depend on {', '.join(sorted(names - known))}: must be one of "
            f"{', '.join(sorted(known))}"
        )
    return names
