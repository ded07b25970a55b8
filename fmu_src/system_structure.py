"""SSP 1.0 documents of the closed loop: connections and parameters of slider and controller.

Hosts read a package in different ways. libcosim and ecos refuse connections to the system, and take
parameters from the components only; fmpy takes inputs that vary from connectors of the system only;
OMSimulator needs another name for each structure. So `SystemStructure.ssd`, which every host reads,
has components alone, with their parameters, and a second structure has the connectors too.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree as ET

from fmu_src import __version__
from fmu_src.python.slider_component.variable import Variable
from fmu_src.units import UNITS
from fmu_src.xml_text import xml_bytes

_SSP = "http://ssp-standard.org/SSP1/SystemStructure"
_NAMESPACES = {
    "xmlns:ssc": f"{_SSP}Common",
    "xmlns:ssd": f"{_SSP}Description",
    "xmlns:ssv": f"{_SSP}ParameterValues",
}


@dataclass(frozen=True)
class Connection:
    """A connection from an output or system connector to an input or system connector.

    Each end is "component.variable", or just the name of a system connector.
    """

    start: str
    end: str


@dataclass(frozen=True)
class System:
    """Components by name, each an FMU with some of its variables, and their connections.

    `sources` are the paths of the FMUs in the package, `variables` the tables of the components,
    `stop_time` (s) is the end of an experiment.
    """

    name: str
    description: str
    sources: Mapping[str, str]
    variables: Mapping[str, Sequence[Variable]]
    connections: Sequence[Connection]
    stop_time: float

    def variable(self, end: str) -> Variable:
        """Return the variable at an end "component.variable". Raises KeyError if it is unknown."""
        component, _, name = end.partition(".")
        return {v.name: v for v in self.variables[component]}[name]

    @property
    def connectors(self) -> dict[str, tuple[str, Variable]]:
        """System connectors: name -> kind and the variable that it connects to."""
        found: dict[str, tuple[str, Variable]] = {}
        for connection in self.connections:
            if "." not in connection.start:
                found[connection.start] = ("input", self.variable(connection.end))
            if "." not in connection.end:
                found[connection.end] = ("output", self.variable(connection.start))
        return found


@dataclass(frozen=True)
class ParameterValues:
    """A named set of start values, by "component.variable"."""

    name: str
    values: Mapping[str, float]


def structure(
    system: System, *, source: str, parameters: ParameterValues, connectors: bool = False
) -> bytes:
    """Return the system as an .ssd document, UTF-8; equal arguments give equal bytes.

    `parameters` are bound twice, to the same values: to the system as the parameter set at the path
    `source` in the package, and to each component. `connectors` includes the system connectors, and
    names the document after them. Raises KeyError for an unknown component or variable.
    """
    name = f"{system.name}WithConnectors" if connectors else system.name
    root = _root("ssd:SystemStructureDescription", name, system.description)
    top = ET.SubElement(root, "ssd:System", {"name": system.name})
    if connectors:
        _add_connectors(top, [(n, kind, v) for n, (kind, v) in system.connectors.items()])
    bindings = ET.SubElement(top, "ssd:ParameterBindings")
    ET.SubElement(bindings, "ssd:ParameterBinding", {"source": source})
    elements = ET.SubElement(top, "ssd:Elements")
    for component_name, fmu in system.sources.items():
        attributes = {
            "name": component_name,
            "type": "application/x-fmu-sharedlibrary",
            "source": fmu,
        }
        component = ET.SubElement(elements, "ssd:Component", attributes)
        used = _used(system, component_name, connectors=connectors)
        _add_connectors(component, [(v.name, v.causality, v) for v in used])
        _bind(component, system, component_name, parameters)
    _add_connections(top, [c for c in system.connections if connectors or _inside(c)])
    _add_units(root, (v for table in system.variables.values() for v in table))
    ET.SubElement(
        root, "ssd:DefaultExperiment", {"startTime": "0.0", "stopTime": repr(system.stop_time)}
    )
    return xml_bytes(root)


def parameter_set(system: System, parameters: ParameterValues) -> bytes:
    """Return a parameter set as an .ssv document, UTF-8.

    Raises KeyError for an unknown component or variable.
    """
    root = _root("ssv:ParameterSet", parameters.name, f"Parameters of {system.name}")
    _add_parameters(root, {end: (system.variable(end), v) for end, v in parameters.values.items()})
    return xml_bytes(root)


def _bind(
    component: ET.Element, system: System, component_name: str, parameters: ParameterValues
) -> None:
    """Bind those of the parameters that are the component's, named as in its FMU."""
    own = {
        end.partition(".")[2]: (system.variable(end), value)
        for end, value in parameters.values.items()
        if end.partition(".")[0] == component_name
    }
    bindings = ET.SubElement(component, "ssd:ParameterBindings")
    binding = ET.SubElement(bindings, "ssd:ParameterBinding")
    values = ET.SubElement(binding, "ssd:ParameterValues")
    about = {"version": "1.0", "name": parameters.name}
    _add_parameters(ET.SubElement(values, "ssv:ParameterSet", about), own)


def _add_parameters(root: ET.Element, values: Mapping[str, tuple[Variable, float]]) -> None:
    parameters = ET.SubElement(root, "ssv:Parameters")
    for name, (variable, value) in values.items():
        parameter = ET.SubElement(parameters, "ssv:Parameter", {"name": name})
        if variable.type == "Integer":
            ET.SubElement(parameter, "ssv:Integer", {"value": str(int(value))})
        else:
            real = {"value": repr(float(value)), "unit": variable.unit or "1"}
            ET.SubElement(parameter, "ssv:Real", real)
    _add_units(root, [variable for variable, _ in values.values()], "ssv")


def _used(system: System, component: str, *, connectors: bool) -> list[Variable]:
    """Return outputs and connected inputs only: some hosts set every input connector to 0."""
    ends = {c.end for c in system.connections if connectors or _inside(c)}
    return [
        v
        for v in system.variables[component]
        if v.causality == "output" or f"{component}.{v.name}" in ends
    ]


def _inside(connection: Connection) -> bool:
    return "." in connection.start and "." in connection.end


def _root(tag: str, name: str, description: str) -> ET.Element:
    about = {"version": "1.0", "name": name, "description": description, "license": "MIT"}
    return ET.Element(
        tag, {**_NAMESPACES, **about, "generationTool": f"slider-resonator {__version__}"}
    )


def _add_connectors(parent: ET.Element, connectors: Iterable[tuple[str, str, Variable]]) -> None:
    element = ET.SubElement(parent, "ssd:Connectors")
    for name, kind, variable in connectors:
        connector = ET.SubElement(element, "ssd:Connector", {"name": name, "kind": kind})
        ET.SubElement(connector, "ssc:Real", {"unit": variable.unit or "1"})


def _add_connections(parent: ET.Element, connections: Iterable[Connection]) -> None:
    element = ET.SubElement(parent, "ssd:Connections")
    for connection in connections:
        attributes: dict[str, str] = {}
        for end, place in ((connection.start, "start"), (connection.end, "end")):
            component, dot, variable = end.rpartition(".")
            if dot:
                attributes[f"{place}Element"] = component
            attributes[f"{place}Connector"] = variable
        ET.SubElement(element, "ssd:Connection", attributes)


def _add_units(root: ET.Element, variables: Iterable[Variable], prefix: str = "ssd") -> None:
    used = {v.unit or "1" for v in variables if v.type == "Real"}
    units = ET.SubElement(root, f"{prefix}:Units")
    for name, unit in UNITS.items():
        if name in used:
            element = ET.SubElement(units, "ssc:Unit", {"name": name})
            ET.SubElement(element, "ssc:BaseUnit", {b: str(e) for b, e in unit.exponents.items()})
