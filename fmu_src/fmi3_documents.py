"""The other XML documents of an FMI 3.0 FMU: its terminal and icon, and how to build it."""

from collections.abc import Iterable
from xml.etree import ElementTree as ET

from fmu_src.xml_text import xml_bytes

FLANGE = ("position", "velocity", "load")
"""The variables of the translational flange: the slider's motion, and the load on it."""

_FRAME = {"x1": "-100.0", "y1": "-100.0", "x2": "100.0", "y2": "100.0"}


def terminals_and_icons() -> bytes:
    """Return terminalsAndIcons.xml: the flange of the slider, and the frame of icon.png.

    The members connect by name. `load` is a signal, not a flow: its sign is that of a force against
    the motion, and it need not balance the loads of other components.
    """
    root = ET.Element("fmiTerminalsAndIcons", {"fmiVersion": "3.0"})
    picture = ET.SubElement(root, "GraphicalRepresentation")
    ET.SubElement(picture, "CoordinateSystem", {**_FRAME, "suggestedScalingFactorTo_mm": "0.1"})
    ET.SubElement(picture, "Icon", _FRAME)
    terminals = ET.SubElement(root, "Terminals")
    flange = ET.SubElement(
        terminals,
        "Terminal",
        {
            "name": "flange",
            "matchingRule": "bus",
            "description": "Translational flange of the slider: its motion and the load on it",
        },
    )
    for name in FLANGE:
        member = {"variableName": name, "memberName": name, "variableKind": "signal"}
        ET.SubElement(flange, "TerminalMemberVariable", member)
    return xml_bytes(root)


def build_description(model: str, source_files: Iterable[str]) -> bytes:
    """Return buildDescription.xml: the C files to compile, in the folder of the document."""
    root = ET.Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    build = ET.SubElement(root, "BuildConfiguration", {"modelIdentifier": model})
    files = ET.SubElement(build, "SourceFileSet", {"language": "C99"})
    for name in source_files:
        ET.SubElement(files, "SourceFile", {"name": name})
    return xml_bytes(root)
