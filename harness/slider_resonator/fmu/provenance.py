"""Provenance of a report: the FMUs, the versions of the tools, the machine and the date.

As data, and as part of a report: HTML, Markdown, and properties for JUnit.
"""

import hashlib
import os
import platform
import re
import zipfile
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy

from slider_resonator import __version__
from slider_resonator.errors import HarnessError
from slider_resonator.output import html_page, markdown
from slider_resonator.output.table import Table, texts

DATE_VARIABLE = "SOURCE_DATE_EPOCH"
"""Environment variable with the date of reproducible reports, in seconds since 1970."""

_MAX_EPOCH = 253402300799
"""The last second of the year 9999, the last year that a date can have."""
_CPU_NAME = re.compile(r"^model name\s*:\s*(.+)$", re.MULTILINE)


@dataclass(frozen=True)
class FmuIdentity:
    """An FMU file: its path, and what identifies its content; None for what cannot be read.

    `version` and `generation_tool` are those of its model description, "" where it states none.
    """

    fmu: str
    guid: str | None
    sha256: str | None
    version: str | None
    generation_tool: str | None


@dataclass(frozen=True)
class Provenance:
    """What a report was made of and with.

    `cpu` names the processor, which timings depend on; `date` is in ISO 8601, UTC.
    """

    fmus: tuple[FmuIdentity, ...]
    harness: str
    fmpy: str
    python: str
    platform: str
    cpu: str
    date: str


def provenance_of(*fmus: str | Path | FmuIdentity) -> Provenance:
    """Return the provenance of a report on FMU files, which need not be usable or exist.

    Raises HarnessError for a SOURCE_DATE_EPOCH that is no date.
    """
    cpu = platform.processor()
    with suppress(OSError):  # Linux only
        found = _CPU_NAME.search(Path("/proc/cpuinfo").read_text(encoding="utf-8"))
        cpu = found[1].strip() if found else cpu
    given = os.environ.get(DATE_VARIABLE)
    if given and not (given.isascii() and given.isdigit() and int(given) <= _MAX_EPOCH):
        raise HarnessError(f"{DATE_VARIABLE} = {given!r}: must be whole seconds since 1970")
    date = datetime.fromtimestamp(int(given), UTC) if given else datetime.now(UTC)
    return Provenance(
        fmus=tuple(fmu if isinstance(fmu, FmuIdentity) else identity_of(fmu) for fmu in fmus),
        harness=__version__,
        fmpy=str(fmpy.__version__),
        python=platform.python_version(),
        platform=f"{platform.system()} {platform.release()} {platform.machine()}",
        cpu=f"{cpu or platform.machine()}, {os.cpu_count()} logical cores",
        date=date.isoformat(timespec="seconds"),
    )


def identity_of(fmu: str | Path) -> FmuIdentity:
    """Return what identifies an FMU file, as far as a missing or corrupt one allows."""
    guid = version = tool = digest = None
    with suppress(OSError):
        digest = digest_of(Path(fmu))
    # It may have no description, or a corrupt one; of any no more than the root is read.
    with (
        suppress(Exception),
        zipfile.ZipFile(fmu) as archive,
        archive.open("modelDescription.xml") as file,
    ):
        _, root = next(ET.iterparse(file, events=("start",)))
        guid = root.get("guid", root.get("instantiationToken"))
        version, tool = root.get("version", ""), root.get("generationTool", "")
    return FmuIdentity(str(fmu), guid, digest, version, tool)


def digest_of(fmu: Path) -> str:
    """Return the SHA-256 of the content of a file."""
    with fmu.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def provenance_html(provenance: Provenance) -> str:
    """Return a section of a page."""
    tables = "".join(html_page.rendered(one) for one in _tables(provenance))
    return f'<section id="provenance"><h2>Provenance</h2>{tables}</section>'


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
    """Return a table of the FMUs and one of tools, machine and date."""
    fmus = [
        [text or "-" for text in (Path(f.fmu).name, f.guid, f.version, f.generation_tool, f.sha256)]
        for f in provenance.fmus
    ]
    names = ("date", "harness", "fmpy", "python", "platform", "cpu")
    tools = [getattr(provenance, name) for name in names]
    tables = [Table(texts("date", "harness", "fmpy", "Python", "platform", "CPU"), [tools])]
    if fmus:
        heads = texts("FMU", "GUID", "version", "generation tool", "SHA-256")
        tables.insert(0, Table(heads, fmus))
    return tables
