"""The documentation page inside the FMU: fixed text around tables of the variables.

The tables that help to choose a model are measurements by the harness's command `trade`. They are
committed, so that equal sources give equal bytes.
"""

import re
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from string import Template
from typing import Literal

from fmu_src.model_description import DESCRIPTION
from fmu_src.model_description_3 import REFERENCE_OFFSET, TYPES
from fmu_src.python.slider_component.variable import Variable
from fmu_src.python.slider_component.variables import VARIABLES

ASSETS = Path(__file__).parent / "assets"

_CONTENTS = "<!-- contents -->"

_HEADINGS: tuple[tuple[str, str], ...] = (
    ("input", "Inputs: may be set at any time"),
    ("tunable", "Tunable parameters: may be set at any time"),
    ("fixed", "Fixed parameters: may be set until initialization ends"),
    ("output", "Outputs"),
)


def documentation_page(
    *,
    model: str,
    generation_tool: str,
    host: Literal["native", "native_3", "python"],
    about: str = DESCRIPTION,
    page: str = "page.html",
    variables: Sequence[Variable] = VARIABLES,
) -> bytes:
    """Return a self-contained HTML page as UTF-8 bytes; equal arguments give equal bytes.

    `page` is the fixed text in `assets`, `about` describes the model in a sentence, `host` selects
    the section on statuses, messages and requirements of the target.
    """
    template = Template((ASSETS / page).read_text(encoding="utf-8"))
    page = template.substitute(
        choosing=_asset("choosing.html"),
        host=_asset(f"{host}_host.html"),
        model=escape(model),
        description=escape(about),
        generation_tool=escape(generation_tool),
        contents=_CONTENTS,
        browser="" if host == "python" else _asset("browser.html"),
        **_version_texts("3.0" if host == "native_3" else "2.0", variables),
    )
    return _with_contents(page).encode()


def _with_contents(page: str) -> str:
    """Give each section an anchor and list them where the page asks for it."""
    titles: list[str] = re.findall(r"<h2>(.*?)</h2>", page)
    for number, title in enumerate(titles, start=1):
        page = page.replace(f"<h2>{title}</h2>", f'<h2 id="section-{number}">{title}</h2>', 1)
    links = "\n".join(
        f'<a href="#section-{number}">{title}</a><br>' for number, title in enumerate(titles, 1)
    )
    return page.replace(_CONTENTS, f"<nav>\n{links}\n</nav>")


def _version_texts(version: str, variables: Sequence[Variable]) -> dict[str, str]:
    """Return what the page says about a version of FMI."""
    if version == "3.0":
        return {
            "version": version,
            "reset": "fmi3Reset",
            "first_reference": f"{REFERENCE_OFFSET}, after that of <code>time</code>,",
            "variables": _variable_tables(variables, REFERENCE_OFFSET, TYPES),
        }
    return {
        "version": version,
        "reset": "fmi2Reset",
        "first_reference": "0",
        "variables": _variable_tables(variables, 0, {}),
    }


def _asset(name: str) -> str:
    return (ASSETS / name).read_text(encoding="utf-8").rstrip("\n")


def _variable_tables(variables: Sequence[Variable], first: int, types: Mapping[str, str]) -> str:
    references = {v.name: i for i, v in enumerate(variables, start=first)}
    tables = []
    for kind, heading in _HEADINGS:
        rows = [
            _row(references[v.name], types.get(v.type, v.type), v)
            for v in variables
            if kind in (v.causality, v.variability if v.causality == "parameter" else None)
        ]
        head = "".join(
            f"<th>{title}</th>"
            for title in ("Reference", "Name", "Type", "Unit", "Start", "Min", "Max", "Meaning")
        )
        body = "\n".join(rows)
        tables.append(f"<h3>{heading}</h3>\n<table>\n<tr>{head}</tr>\n{body}\n</table>")
    return "\n".join(tables)


def _row(reference: int, type_name: str, v: Variable) -> str:
    unit = v.unit or ""
    if v.display_unit:
        unit += f" (shown in {v.display_unit})"
    numbers = "".join(
        f'<td class="number">{"" if x is None else f"{x:g}"}</td>'
        for x in (v.start, v.minimum, v.maximum)
    )
    return (
        f'<tr><td class="number">{reference}</td><td><code>{escape(v.name)}</code></td>'
        f"<td>{type_name}</td><td>{escape(unit)}</td>{numbers}<td>{escape(v.description)}</td></tr>"
    )
