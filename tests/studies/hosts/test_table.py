from __future__ import annotations

import re
from pathlib import Path

from slider_resonator.output import markdown
from studies.hosts.hosts import hosts
from studies.hosts.runs import CASES, FMI_3, HostComparison, HostResult
from studies.hosts.table import BEGIN, COLUMNS, END, host_table, write_table

PAGE = Path(__file__).parents[3] / "docs" / "hosts.md"
RESULT = HostResult(
    "a host",
    "1.2",
    "native",
    dict.fromkeys(CASES, HostComparison(0.0)) | {CASES[1]: HostComparison(3e-14)},
)


def test_a_row_says_host_version_fmu_and_each_deviation() -> None:
    assert markdown.rendered(host_table([RESULT])).splitlines() == [
        "| host | version | FMU | "
        "Coulomb 2 | Coulomb 1 | Coulomb 0 | LuGre 2 | LuGre 1 | LuGre 0 |",
        "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |",
        "| a host | 1.2 | native | 0 | 3e-14 | 0 | 0 | 0 | 0 |",
    ]


def test_what_fails_stands_out() -> None:
    failed = {CASES[0]: HostComparison(None, "refused"), CASES[2]: HostComparison(0.5)}
    result = HostResult("a host", "1.2", "native", {**RESULT.comparisons, **failed})
    assert "| **failed** | 3e-14 | **5e-01** |" in markdown.rendered(host_table([result]))


def test_the_table_goes_between_its_marks(tmp_path: Path) -> None:
    path = tmp_path / "README.md"
    path.write_text(f"before\n{BEGIN}\nold\n{END}\nafter\n")
    write_table(path, host_table([RESULT]))
    table = markdown.rendered(host_table([RESULT]))
    assert path.read_text() == f"before\n{BEGIN}\n{table}\n{END}\nafter\n"


def test_the_table_of_the_page_is_one_that_this_code_writes() -> None:
    text = PAGE.read_text(encoding="utf-8")
    between = text.partition(BEGIN)[2].partition(END)[0].strip().splitlines()
    head, _, *rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in between]
    assert head == [column.heading for column in COLUMNS]
    found: dict[str, list[str]] = {}
    for name, version, fmu, *deviations in rows:
        assert version, f"the version of {name} is missing"
        assert len(deviations) == len(CASES)
        for deviation in deviations:
            assert re.fullmatch(r"0|\de-\d\d", deviation), f"{name}: {deviation} is no agreement"
        found.setdefault(name, []).append(fmu)
    assert list(found) == [host.name for host in hosts()]
    for host in hosts():
        fmus = ["native", "Python"] if host.loads_python else ["native"]
        fmus += [FMI_3] if host.loads_fmi_3 else []
        assert found[host.name] == (["native behind Python"] if host.couples else fmus)
