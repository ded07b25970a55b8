from __future__ import annotations

import json
from dataclasses import replace
from html import escape
from pathlib import Path

from studies.paper.claim import Claim, statements
from studies.paper.listing import (
    write_claims,
    write_index,
    write_tables,
)
from studies.paper.reproduce import FIGURES
from studies.paper.table import PaperTable
from tests.harness.known_provenance import PROVENANCE

CLAIM = Claim("speed", "(5)", "It moves", {"v_m_per_s": 0.5}, "agrees", "it | does", True)


def test_claims_are_written_as_markdown_and_json(tmp_path: Path) -> None:
    wrong = replace(CLAIM, name="other", verdict="disagrees", confirmed=False)
    write_claims(tmp_path, [("All", [CLAIM, wrong])], PROVENANCE)
    claims = json.loads((tmp_path / "claims.json").read_text(encoding="utf-8"))["claims"]
    assert [claim["confirmed"] for claim in claims] == [True, False]
    table = (tmp_path / "claims.md").read_text(encoding="utf-8")
    assert "| It moves | (5) | v: 0.5 m/s | agrees | it \\| does |" in table
    assert "**NOT CONFIRMED**" in table


def test_every_statement_is_complete() -> None:
    for name, statement in statements().items():
        assert list(statement) == ["where", "statement", "verdict", "why"], name
        assert statement["verdict"] in ("agrees", "agrees in part", "disagrees"), name


def test_tables_are_written_as_markdown_and_json(tmp_path: Path) -> None:
    columns = {"kappa": "kappa", "error": "theory / FMU - 1"}
    table = PaperTable("forces", "Forces", "In N.", columns, {"error": 0.1}, lambda i: {})
    right = {"rows": [{"kappa": 1.0, "error": -0.05}, {"kappa": 10.0, "error": 0.02}]}
    write_tables(tmp_path, [(table, right)], PROVENANCE)
    text = (tmp_path / "TABLES.md").read_text(encoding="utf-8")
    assert "## forces: Forces" in text
    assert "| kappa | theory / FMU - 1 |\n| ---: | ---: |\n| 1 | -0.05 |\n| 10 | 0.02 |" in text
    assert "Largest theory / FMU - 1: 0.05, allowed 0.1." in text
    content = json.loads((tmp_path / "forces.json").read_text(encoding="utf-8"))
    assert content["rows"] == right["rows"]
    assert (content["largest"], content["allowed"]) == ({"error": 0.05}, {"error": 0.1})
    wrong = {"rows": [{"kappa": 1.0, "error": -0.5}]}
    write_tables(tmp_path, [(table, wrong)], PROVENANCE)
    assert "**NOT CONFIRMED**" in (tmp_path / "TABLES.md").read_text(encoding="utf-8")


def test_one_deviation_too_large_of_either_sign_is_enough() -> None:
    columns = {"kappa": "kappa", "error": "e", "other": "o"}
    table = PaperTable("t", "T", "", columns, {"error": 0.1, "other": 1.0}, lambda i: {})
    data = {"rows": [{"kappa": 9.0, "error": -0.1, "other": 0.0}, {"error": 0.05, "other": 1.0}]}
    assert table.largest(data) == {"error": 0.1, "other": 1.0}
    assert table.confirmed(data)
    assert not table.confirmed({"rows": [{"error": -0.11, "other": 0.0}]})
    assert not table.confirmed({"rows": [{"error": 0.0, "other": 0.0}, {"error": 0, "other": 2}]})


def test_the_index_has_all_figures_tables_and_claims_escaped(tmp_path: Path) -> None:
    wrong = replace(CLAIM, statement="It <b>flies</b>", verdict="disagrees", confirmed=False)
    table = PaperTable("speeds", "Speeds", "By <load>.", {"v": "speed"}, {"v": 0.1}, lambda _: {})
    data = {"rows": [{"v": 0.2}]}
    fmu = replace(PROVENANCE.fmus[0], fmu="<a>.fmu")
    known = replace(PROVENANCE, fmus=(fmu,))
    write_index(tmp_path, FIGURES.values(), [(table, data)], [("All", [CLAIM, wrong])], known)
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    for figure in FIGURES.values():
        assert f'<img src="{figure.name}.png" alt="{escape(figure.title)}">' in page
        assert escape(figure.caption) in page
    assert "It moves" in page
    assert "It &lt;b&gt;flies&lt;/b&gt;" in page
    assert "NOT CONFIRMED" in page
    assert "By &lt;load&gt;." in page
    assert "&lt;a&gt;.fmu" in page
    assert "0123abcd" in page
    assert "img-src data: 'self' file:" in page
