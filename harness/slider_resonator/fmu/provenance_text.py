"""Provenance as part of a report: HTML, Markdown, and properties for JUnit."""

from pathlib import Path

from slider_resonator.fmu.provenance import FmuIdentity, Provenance
from slider_resonator.output import html_page, markdown
from slider_resonator.output.table import Table, texts

HEADING = "Provenance"


def provenance_html(provenance: Provenance) -> str:
    """Return a section of a page."""
    tables = "".join(html_page.rendered(one) for one in _tables(provenance))
    return f'<section id="provenance"><h2>{HEADING}</h2>{tables}</section>'


def provenance_markdown(provenance: Provenance) -> str:
    """Return tables without a heading."""
    return "\n\n".join(map(markdown.rendered, _tables(provenance)))


def provenance_properties(provenance: Provenance, fmu: FmuIdentity | None) -> dict[str, str]:
    """Return each known fact about one FMU, or none, and about tools and machine by its name."""
    of_fmu = {} if fmu is None else vars(fmu)
    found = {name if name == "fmu" else f"fmu_{name}": value for name, value in of_fmu.items()}
    found |= {name: value for name, value in vars(provenance).items() if name != "fmus"}
    return {name: value for name, value in found.items() if value is not None}


def _tables(provenance: Provenance) -> list[Table]:
    """Return a table of the FMUs, if any, and one of tools, machine and date."""
    fmus = [
        (Path(one.fmu).name, *(value or "-" for value in facts))
        for one in provenance.fmus
        for facts in [(one.guid, one.version, one.generation_tool, one.sha256)]
    ]
    tools = (
        *(provenance.date, provenance.harness, provenance.fmpy, provenance.python),
        *(provenance.platform, provenance.cpu),
    )
    tables = [Table(texts("date", "harness", "fmpy", "Python", "platform", "CPU"), [tools])]
    if fmus:
        tables.insert(0, Table(texts("FMU", "GUID", "version", "generation tool", "SHA-256"), fmus))
    return tables
