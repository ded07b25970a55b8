"""XML documents as bytes that do not depend on the machine."""

from xml.etree import ElementTree as ET


def xml_bytes(root: ET.Element) -> bytes:
    """Return a document with an XML declaration, indented, as UTF-8."""
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()
