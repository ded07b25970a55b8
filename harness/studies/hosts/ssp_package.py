"""The two structures in an SSP package, for hosts that read one or the other."""

import zipfile
from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree as ET

STRUCTURE = "SystemStructure.ssd"
"""Components only: libcosim and ecos refuse connections with the outside."""

WITH_CONNECTORS = "WithConnectors.ssd"
"""The same with connectors of the system, which fmpy needs for inputs that vary."""

_SSD = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"


def system_inputs(package: str) -> Mapping[str, str]:
    """Return the "component.variable" behind each input of the system.

    Raises KeyError where the package has no structure with connectors.
    """
    with zipfile.ZipFile(package) as archive, archive.open(WITH_CONNECTORS) as file:
        root = ET.parse(file).getroot()
    return {
        connection.attrib["startConnector"]: f"{connection.attrib['endElement']}."
        f"{connection.attrib['endConnector']}"
        for connection in root.iterfind(f"{_SSD}System/{_SSD}Connections/{_SSD}Connection")
        if "startElement" not in connection.attrib
    }


def write_with_connectors(package: str, target: Path) -> None:
    """Write the package with the other structure as its first.

    Raises KeyError where the package has no structure with connectors.
    """
    with zipfile.ZipFile(package) as source, zipfile.ZipFile(target, "w") as archive:
        archive.writestr(STRUCTURE, source.read(WITH_CONNECTORS))
        for name in source.namelist():
            if name not in (STRUCTURE, WITH_CONNECTORS):
                archive.writestr(name, source.read(name))
