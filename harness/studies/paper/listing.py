"""The texts of the report: captions of the figures, tables and claims."""

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from slider_resonator.fmu.provenance import Provenance, provenance_html, provenance_markdown
from slider_resonator.output import html_page, markdown
from slider_resonator.output.files import write_text
from slider_resonator.output.json_output import to_json
from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts
from studies.paper.claim import Claim
from studies.paper.figure import Data, PaperFigure
from studies.paper.table import PaperTable

HEAD = (
    "The FMU runs with masses, loads and reference frequency of 1, so that its SI values are the "
    "paper's dimensionless ones; numbers in brackets are equations of the paper."
)


_UNITS = {"_m_per_s": "m/s", "_N": "N", "_rad": "rad", "_um": "um", "_hertz": "Hz"}
"""How the name of a number ends, and its unit."""


def write_figures(folder: Path, figures: Iterable[PaperFigure], provenance: Provenance) -> None:
    """Write FIGURES.md with the caption of each figure; HarnessError when it cannot be written."""
    lines = ["# Figures", "", _origin(provenance), HEAD, ""]
    for figure in figures:
        lines += [f"## {figure.name}: {figure.title}", "", f"![{figure.title}]({figure.name}.png)"]
        lines += ["", f"{figure.caption} ([SVG]({figure.name}.svg))", ""]
    write_text(folder / "FIGURES.md", "\n".join(lines))


def write_tables(
    folder: Path, tables: Sequence[tuple[PaperTable, Data]], provenance: Provenance
) -> None:
    """Write TABLES.md with all tables and a JSON file for each.

    Raises HarnessError when they cannot be written.
    """
    lines = ["# Tables", "", _origin(provenance), ""]
    for table, data in tables:
        content = {
            **_fmu(provenance),
            "title": table.title,
            "caption": table.caption,
            "columns": table.columns,
            "largest": table.largest(data),
            "allowed": table.bounds,
            "rows": data["rows"],
        }
        write_text(folder / f"{table.name}.json", to_json(content, provenance) + "\n")
        lines += [f"## {table.name}: {table.title}", "", table.caption, ""]
        lines += [markdown.rendered(_measured(table, data)), ""]
        lines += _largest(table, data, "**NOT CONFIRMED**")
        lines.append("")
    write_text(folder / "TABLES.md", "\n".join(lines))


def write_claims(
    folder: Path, groups: Sequence[tuple[str, Sequence[Claim]]], provenance: Provenance
) -> None:
    """Write claims.json and claims.md from (title, claims) of every group.

    Raises HarnessError when they cannot be written.
    """
    claims = [claim for _, group in groups for claim in group]
    content = {**_fmu(provenance), "claims": claims}
    write_text(folder / "claims.json", to_json(content, provenance) + "\n")
    lines = ["# Statements of the paper, and what was measured", "", _origin(provenance)]
    lines += [verdicts(claims), ""]
    for title, group in groups:
        lines += [f"## {title}", "", markdown.rendered(_claim_table(group)), ""]
    write_text(folder / "claims.md", "\n".join(lines))


def write_index(
    folder: Path,
    figures: Iterable[PaperFigure],
    tables: Sequence[tuple[PaperTable, Data]],
    groups: Sequence[tuple[str, Sequence[Claim]]],
    provenance: Provenance,
) -> None:
    """Write index.html, with all figures beside it, tables and claims.

    Raises HarnessError when it cannot be written.
    """
    text = html_page.escaped
    parts = [f"<p>{text(HEAD)}</p>"]
    claims = [claim for _, group in groups for claim in group]
    if claims:
        parts.append(f"<h2>Statements of the paper</h2><p>{text(verdicts(claims))}</p>")
    for title, group in groups:
        parts.append(f"<h3>{text(title)}</h3>{html_page.rendered(_claim_table(group))}")
    for figure in figures:
        name, title = text(figure.name), text(figure.title)
        parts.append(
            f'<h2 id="{name}">{name}: {title}</h2><a href="{name}.svg">'
            f'<img src="{name}.png" alt="{title}"></a><p>{text(figure.caption)}</p>'
        )
    for shown, data in tables:
        heading = f"{shown.name}: {shown.title}"
        parts.append(f"<h2>{text(heading)}</h2><p>{text(shown.caption)}</p>")
        parts.append(html_page.rendered(_measured(shown, data)))
        parts += [f"<p>{text(line)}</p>" for line in _largest(shown, data)]
    parts.append(provenance_html(provenance))
    html_page.write_page(folder / "index.html", "The paper, reproduced", parts)


def _measured(table: PaperTable, data: Data) -> Table:
    rows = [[_number(row[name]) for name in table.columns] for row in data["rows"]]
    return Table(numbers(*table.columns.values()), rows)


def _largest(table: PaperTable, data: Data, wrong: str = "NOT CONFIRMED") -> list[str]:
    """Return a sentence for each deviation that is judged."""
    lines = []
    for name, size in table.largest(data).items():
        verdict = "" if size <= table.bounds[name] else f", {wrong}"
        meaning = table.columns[name]
        lines.append(f"Largest {meaning}: {size:.2g}, allowed {table.bounds[name]:g}{verdict}.")
    return lines


def verdicts(claims: Sequence[Claim]) -> str:
    """Return a sentence that counts the verdicts."""
    counts = Counter(c.verdict if c.confirmed else "not confirmed" for c in claims)
    listed = ", ".join(f"{count} {name}" for name, count in counts.items())
    return f"{len(claims)} statements: {listed}."


def _claim_table(claims: Iterable[Claim]) -> Table:
    rows: list[Row] = []
    for one in claims:
        measured = "\n".join(_named_number(name, value) for name, value in one.numbers.items())
        verdict = Cell(one.verdict) if one.confirmed else Cell("NOT CONFIRMED", Style.FAIL)
        rows.append((one.statement, one.where, measured, verdict, one.why))
    return Table(texts("statement", "where", "measured", "verdict", "why"), rows)


def _named_number(name: str, value: float | None) -> str:
    """Return a number of a claim with its unit, by which its name may end."""
    ending = next((ending for ending in _UNITS if name.endswith(ending)), "")
    label = name.removesuffix(ending).replace("_", " ")
    return f"{label}: {_number(value)} {_UNITS.get(ending, '')}".rstrip()


def _number(value: float | None) -> str:
    return "none" if value is None else f"{value:.6g}"


def _fmu(provenance: Provenance) -> dict[str, str | None]:
    return {"fmu": Path(provenance.fmus[0].fmu).name, "guid": provenance.fmus[0].guid}


def _origin(provenance: Provenance) -> str:
    return provenance_markdown(provenance) + "\n"
