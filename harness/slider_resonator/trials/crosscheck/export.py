"""Writing the tree: a folder for each platform and case."""

from __future__ import annotations

import csv
import os
import re
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path

import fmpy

from slider_resonator.device.interface import INPUTS
from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.opening import Fmu
from slider_resonator.fmu.record import Record
from slider_resonator.fmu.run import run
from slider_resonator.output.targets import make_folder
from slider_resonator.trials.crosscheck.cases import CASES, OUTPUTS, STEP_SIZE, STOP_TIME, Case

PLATFORMS = ("c-code", "darwin64", "linux32", "linux64", "win32", "win64")
"""Names of platforms that the rules know."""
FOLDER_NAME = re.compile(r"\w[\w.+-]*", re.ASCII)
"""What tools and versions may be called: a folder that every file system takes."""
RELATIVE_TOLERANCE = 1e-8
"""What an importer with a variable step is advised to ask of its solver."""


def case_folders(out: Path, fmu: Fmu, tool: str) -> list[tuple[Path, Case]]:
    """Return the folder of each platform and case, in the order of the rules.

    Raises FmuError for an FMU that asks for more than a host can be expected to have: the rules
    allow none of it.
    """
    if not fmu.runs_without_python:
        raise FmuError(
            f"{fmu.path}: needs a Python interpreter in the importing tool, but a cross-check "
            "allows only FMUs without requirements; the native FMU has none"
        )
    version = fmu.description.version or ""
    if not FOLDER_NAME.fullmatch(version):
        raise FmuError(
            f"{fmu.path}: the model's version is {version!r}; allowed is the name of a folder of "
            "letters, digits and . _ + -"
        )
    platforms = [name for name in PLATFORMS if name in fmpy.supported_platforms(str(fmu.path))]
    folder = out / "fmus" / "2.0" / "cs"
    return [
        (folder / platform / tool / version / case.name, case)
        for platform in platforms
        for case in CASES
    ]


def export(instance: Instance, out: Path, tool: str) -> list[Path]:
    """Run every case and write the whole tree or nothing; return the folders of the cases.

    Raises HarnessError when a folder is there already or cannot be written, FmuError and Refusal
    when the FMU cannot be run.
    """
    fmu = instance.fmu
    folders = case_folders(out, fmu, tool)
    for folder, _ in folders:
        if folder.exists():
            raise HarnessError(f"{folder}: is there already; remove it first")
    records = {case.name: run(instance, {}, case.schedule, outputs=OUTPUTS) for case in CASES}
    make_folder(out)
    try:
        with tempfile.TemporaryDirectory(dir=out, prefix=".crosscheck-") as unfinished:
            for folder, case in folders:
                _write_case(Path(unfinished) / folder.relative_to(out), fmu, case, records)
            for folder, _ in folders:
                make_folder(folder.parent)
                os.replace(Path(unfinished) / folder.relative_to(out), folder)
    except OSError as error:
        raise HarnessError(f"{out}: cannot be written: {error.strerror or error}") from error
    return [folder for folder, _ in folders]


def _write_case(folder: Path, fmu: Fmu, case: Case, records: Mapping[str, Record]) -> None:
    folder.mkdir(parents=True)
    shutil.copyfile(fmu.path, folder / f"{case.name}.fmu")
    _write_csv(folder / f"{case.name}_in.csv", INPUTS, input_rows(case))
    _write_csv(folder / f"{case.name}_ref.csv", OUTPUTS, _rows(records[case.name]))
    (folder / f"{case.name}_ref.opt").write_text(_options(), encoding="utf-8")
    read_me = _read_me(fmu, case, folder.parents[2].name)
    (folder / "ReadMe.md").write_text(read_me, encoding="utf-8")


def input_rows(case: Case) -> list[list[float]]:
    """Return time (s) and inputs: held between changes, with two rows at each jump.

    Importers interpolate linearly between rows, which leaves such signals as they are.
    """
    held = case.schedule.held()
    rows = []
    for interval in held:
        values = [getattr(interval, name) for name in INPUTS]
        rows += [[interval.start, *values], [interval.stop, *values]]
    return rows


def _rows(record: Record) -> list[list[float]]:
    columns = [record.times, *record.outputs.values()]
    return [list(row) for row in zip(*(column.tolist() for column in columns), strict=True)]


def _write_csv(path: Path, names: Iterable[str], rows: list[list[float]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, quoting=csv.QUOTE_ALL, lineterminator="\n")
        writer.writerow(["time", *names])
        csv.writer(file, lineterminator="\n").writerows(rows)


def _options() -> str:
    options = {
        "StartTime": 0.0,
        "StopTime": STOP_TIME,
        "StepSize": STEP_SIZE,
        "RelTol": RELATIVE_TOLERANCE,
        "OutputIntervalLength": STEP_SIZE,
    }
    return "".join(f"{name}, {value!r}\n" for name, value in options.items())


def _read_me(fmu: Fmu, case: Case, platform: str) -> str:
    description = fmu.description
    rows = (
        ("Model", f"{description.modelName} {description.version}"),
        ("Description", description.description),
        ("FMI", "2.0, co-simulation"),
        ("Platform", platform),
        ("Exporting tool", description.generationTool),
        ("Reference computed on", f"{fmpy.platform}, FMPy {fmpy.__version__}"),
        ("Licence", description.license),
    )
    table = "\n".join(f"| {name} | {value} |" for name, value in rows)
    return f"""# {case.name}

{case.title}.

| | |
|---|---|
{table}

The FMU needs no licence, no tool and no file beside it. All start values stay as they are; the
three inputs follow `{case.name}_in.csv`. They jump at communication points: two rows at one time.

`{case.name}_ref.csv` holds the outputs at communication points {STEP_SIZE:g} s apart. The drive is
at 557 Hz: compare without resampling below 10 kHz.
"""
