"""What is printed at 60 and 80 columns, against the screens in the folder `screens`.

`UPDATE_SCREENS=1 pytest tests/harness/test_screens.py` writes them anew.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from rich.cells import cell_len
from rich.console import Console

from slider_resonator.checks.reports.terminal import MAX_SCENES, print_validation
from slider_resonator.checks.validate import Validation
from slider_resonator.commands.scenes import quantities_table, scenes_table
from slider_resonator.output.table import Table
from slider_resonator.output.terminal import rendered
from slider_resonator.scenes.scene_files import find_scenes
from slider_resonator.scenes.vocabulary import QUANTITIES
from tests.harness.scene_text import scene_of
from tests.harness.verdicts import NONE, PASSED, WORD

SCREENS = Path(__file__).parent / "screens"
WIDTHS = (60, 80, 120)
GOOD = replace(PASSED, scene="table_1", at={}, against="located_events")
THEORY = replace(GOOD, against="closed_form", reference=0.1267305, deviation=6.4e-5, allowed=2.5e-4)
FORCE = replace(GOOD, scene="blocking_force", quantity="blocking_force", unit="N", at={"phase": 0})
LONG = replace(
    GOOD, scene="table_1_high_frequency", quantity="predicted_blocking_force_in_run", unit="N"
)
CHECKS = (GOOD, THEORY, FORCE, LONG, replace(WORD, scene="pushed_at_rest"), NONE)


def screen(show: Callable[[Console], None], width: int) -> str:
    console = Console(
        file=io.StringIO(), width=width, force_terminal=True, color_system=None, highlight=False
    )
    show(console)
    assert isinstance(console.file, io.StringIO)
    return "".join(f"{line.rstrip()}\n" for line in console.file.getvalue().splitlines())


def shown(table: Table) -> Callable[[Console], None]:
    return lambda console: console.print(rendered(table))


def validated(checks: Sequence[object], **options: bool) -> Callable[[Console], None]:
    validation = Validation("dist/my.fmu", tuple(checks), 1.5)  # type: ignore[arg-type]
    return lambda console: print_validation(console, validation, **options)


def some_scenes() -> Table:
    run = "[run]\nstop_time = 0.1\nstep_size = 0.01\n"
    sweep = "[sweep]\nvariable = 'load'\nvalues = [0, 1]\n"
    scenes = [scene_of(run), scene_of(sweep), scene_of(run)]
    names = ("table_1", "serialised_averaged_lugre_state", "pushed_at_rest")
    titles = (
        "The device of table 1",
        "A serialised state of averaged motion with LuGre friction goes on in another instance",
        "Pushed at rest",
    )
    return scenes_table(
        [replace(s, name=n, title=t) for s, n, t in zip(scenes, names, titles, strict=True)]
    )


SHOWN = {
    "validate": validated(CHECKS),
    "validate_details": validated(CHECKS, details=True),
    "scenes": shown(some_scenes()),
}


@pytest.mark.parametrize("width", [60, 80])
@pytest.mark.parametrize("name", SHOWN)
def test_a_screen_is_as_it_was(name: str, width: int) -> None:
    file = SCREENS / f"{name}_{width}.txt"
    printed = screen(SHOWN[name], width)
    if os.environ.get("UPDATE_SCREENS"):
        file.write_text(printed, encoding="utf-8")
    assert printed == file.read_text(encoding="utf-8")


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("name", SHOWN)
def test_no_line_is_wider_than_the_screen(name: str, width: int) -> None:
    assert max(map(cell_len, screen(SHOWN[name], width).splitlines())) <= width


@pytest.mark.parametrize("width", WIDTHS)
def test_no_scene_and_no_quantity_is_cut(width: int) -> None:
    scenes = find_scenes([])
    words = screen(shown(scenes_table(scenes)), width).split()
    assert {scene.name for scene in scenes} <= set(words)
    words = screen(shown(quantities_table()), width).replace(",", " ").split()
    assert set(QUANTITIES) <= set(words)
    assert {name for q in QUANTITIES.values() for name in q.references} <= set(words)


@pytest.mark.parametrize("width", WIDTHS)
def test_no_name_is_cut_in_the_verdicts_of_every_quantity(width: int) -> None:
    checks = [
        replace(GOOD, scene=f"{name}_scene", quantity=name, unit=quantity.unit)
        for name, quantity in QUANTITIES.items()
        if quantity.kind == "number"
    ]
    for start in range(0, len(checks), MAX_SCENES):
        some = checks[start : start + MAX_SCENES]
        for details in (False, True):
            words = screen(validated(some, details=details), width).replace(",", " ").split()
            assert {check.scene for check in some} <= set(words)
            assert {check.quantity for check in some} <= set(words)
