"""SSP 1.0 documents of the closed loop: connections and parameters of slider and controller.

Hosts read a package in different ways: fmpy takes the connectors of the system as its inputs,
libcosim refuses them. So the package has two structures: `SystemStructure.ssd`, and without the
connectors of the system `ComponentsOnly.ssd`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree as ET

from fmu_src import __version__
from fmu_src.python.slider_component.variable import Variable
from fmu_src.units import UNITS

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


def structure(system: System, *, parameters: str | None = None, connectors: bool = True) -> bytes:
    """Return the system as an .ssd document, UTF-8; equal arguments give equal bytes.

    `parameters` is the path of the parameter set in the package; `connectors` includes the system
    connectors. Raises KeyError for a connection to an unknown component or variable.
    """
    root = _root("ssd:SystemStructureDescription", system.name, system.description)
    top = ET.SubElement(root, "ssd:System", {"name": system.name})
    if connectors:
        _add_connectors(top, [(n, kind, v) for n, (kind, v) in system.connectors.items()])
    if parameters is not None:
        bindings = ET.SubElement(top, "ssd:ParameterBindings")
        ET.SubElement(bindings, "ssd:ParameterBinding", {"source": parameters})
    elements = ET.SubElement(top, "ssd:Elements")
    for name, source in system.sources.items():
        attributes = {"name": name, "type": "application/x-fmu-sharedlibrary", "source": source}
        component = ET.SubElement(elements, "ssd:Component", attributes)
        _add_connectors(component, [(v.name, v.causality, v) for v in _used(system, name)])
    _add_connections(top, [c for c in system.connections if connectors or _inside(c)])
    _add_units(root, (v for table in system.variables.values() for v in table))
    ET.SubElement(
        root, "ssd:DefaultExperiment", {"startTime": "0.0", "stopTime": repr(system.stop_time)}
    )
    return _document(root)


def parameter_set(system: System, name: str, values: Mapping[str, float]) -> bytes:
    """Return parameter values, by "component.variable", as an .ssv document, UTF-8.

    Raises KeyError for an unknown component or variable.
    """
    root = _root("ssv:ParameterSet", name, f"Parameters of {system.name}")
    parameters = ET.SubElement(root, "ssv:Parameters")
    for end, value in values.items():
        variable = system.variable(end)
        parameter = ET.SubElement(parameters, "ssv:Parameter", {"name": end})
        if variable.type == "Integer":
            ET.SubElement(parameter, "ssv:Integer", {"value": str(int(value))})
        else:
            real = {"value": repr(float(value)), "unit": variable.unit or "1"}
            ET.SubElement(parameter, "ssv:Real", real)
    _add_units(root, [system.variable(end) for end in values], "ssv")
    return _document(root)


def _used(system: System, component: str) -> list[Variable]:
    """Return outputs and connected inputs only: some hosts set every input connector to 0."""
    ends = {connection.end for connection in system.connections}
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


def _document(root: ET.Element) -> bytes:
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()
