"""Verdicts for CI: a JSON document, JUnit XML, and Markdown on the page of a GitHub Actions run."""

import re
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from slider_resonator.checks.validate import RunFailure, Validation, provenance_of_all
from slider_resonator.checks.verdict import TITLE, measure_of, place, sentence, title
from slider_resonator.errors import HarnessError, explained
from slider_resonator.fmu.provenance import Provenance, provenance_markdown, provenance_properties
from slider_resonator.output.files import replacing
from slider_resonator.output.json_output import to_json
from slider_resonator.output.markdown import escaped, rendered
from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts


def validations_as_json(validations: Sequence[Validation], error: str = "") -> str:
    """Return the verdicts on a single FMU directly, those on several under `fmus`.

    An `error` that stopped the command before it reached an FMU is returned alone.
    """
    provenance = provenance_of_all(validations)
    if error:
        return to_json({"passed": False, "error": error}, provenance)
    plain = [_plain(validation) for validation in validations]
    if len(plain) == 1:
        return to_json(plain[0], provenance)
    passed = all(validation.passed for validation in validations)
    return to_json({"passed": passed, "fmus": plain}, provenance)


def _plain(validation: Validation) -> dict[str, object]:
    checks = [
        {
            **vars(check),
            "deviation_in": measure_of(check),
            "verdict": "pass" if check.passed else sentence(check),
        }
        for check in validation.checks
    ]
    return {
        "fmu": validation.fmu,
        "passed": validation.passed,
        "exit_code": validation.exit_code,
        "wall_time": validation.wall_time,
        "errors": validation.run_failures,
        "lacks": validation.lacks,
        "not_applicable": validation.not_applied,
        "checks": checks,
    }


_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML 1.0 cannot hold: an FMU may have printed them."""
COUNTED = {"tests": "testcase", "failures": "failure", "errors": "error", "skipped": "skipped"}
"""What JUnit counts, by the elements that it counts."""


def write_junit(
    path: Path, validations: Sequence[Validation], error: str = "", *, title: str = TITLE
) -> None:
    """Write one test suite for each FMU, with a test case for each check or failed run.

    `error` is what stopped the command before it reached an FMU. Raises HarnessError when the file
    cannot be written.
    """
    root = ET.Element("testsuites", name=title)
    provenance = provenance_of_all(validations)
    for validation in validations:
        _suite(root, validation, provenance)
    if error:
        _suite(root, Validation(title, (), 0.0, (RunFailure("", error, {}),)), provenance)
    root.set("time", f"{sum(v.wall_time for v in validations):.3f}")
    for element in (root, *root):
        for name, counted in COUNTED.items():
            element.set(name, str(len([*element.iter(counted)])))
    ET.indent(root)
    with replacing(path) as temporary:
        ET.ElementTree(root).write(temporary, encoding="utf-8", xml_declaration=True)


def _suite(root: ET.Element, validation: Validation, provenance: Provenance) -> None:
    suite = ET.SubElement(root, "testsuite", name=_text(validation.fmu))
    suite.set("time", f"{validation.wall_time:.3f}")
    facts = {"judged": validation.without} if validation.without else {}
    facts |= provenance_properties(provenance, validation.identity)
    properties = ET.SubElement(suite, "properties")
    for name, value in facts.items():
        ET.SubElement(properties, "property", name=name, value=_text(value))

    def add(scene: str, name: str, outcome: str = "", said: str = "", more: str = "") -> None:
        case = ET.SubElement(suite, "testcase", classname=scene, name=_text(name))
        if outcome:
            ET.SubElement(case, outcome, message=_text(said)).text = _text(more)

    for scene, quantity, reason in validation.inapplicable:
        add(scene, quantity, "skipped", f"not applicable: {reason}")
    for check in validation.checks:
        if check.passed:
            add(check.scene, title(check))
        else:
            why = f"{sentence(check)}\nexpected because: {check.why}"
            add(check.scene, title(check), "failure", sentence(check), why)
    for one in validation.run_failures:
        name = f"could not be run{place(one.at, ' at ')}"
        add(one.scene or "FMU", name, "error", one.reason, one.reason)


def _text(text: str) -> str:
    return _NOT_XML.sub("\ufffd", text)


VARIABLE = "GITHUB_STEP_SUMMARY"
"""Environment variable with the file that GitHub renders."""
MAX_ROWS = 50
"""Failures shown for each FMU: GitHub takes 1 MiB of summary."""


def append_summary(
    path: Path, validations: Sequence[Validation], error: str = "", *, title: str = TITLE
) -> None:
    """Append a table of FMUs and one of what failed; HarnessError when that is impossible."""
    text = "\n\n".join([f"## {title}", *_parts(validations, error)]) + "\n\n"
    where = f"{VARIABLE} {path}: cannot be written: "
    with explained(where, HarnessError), path.open("a", encoding="utf-8") as file:
        file.write(text)


def _parts(validations: Sequence[Validation], error: str) -> list[str]:
    parts = [f"Could not run: {escaped(error)}"] if error else []
    verdicts, skipped, failures = list[Row](), list[Row](), list[Row]()
    without = []
    for one in validations:
        name, failed = Path(one.fmu).name, len(one.failed)
        counts = (len(one.checks) - failed, failed, len(one.run_failures), len(one.not_applied))
        verdict = Cell(one.outcome, Style.PASS if one.passed else Style.FAIL)
        verdicts.append((one.fmu, verdict, *map(str, counts), f"{one.wall_time:.1f}"))
        if one.without:
            without.append(escaped(f"{name}: {one.without}"))
        skipped += [(name, *row) for row in one.inapplicable[:MAX_ROWS]]
        found = [(f.scene, place(f.at) or "-", f.reason) for f in one.run_failures]
        found += [(check.scene, title(check), sentence(check)) for check in one.failed]
        failures += [(name, *row) for row in found[:MAX_ROWS]]
        if len(found) > MAX_ROWS:
            failures.append((name, "", "", f"and {len(found) - MAX_ROWS} more"))
    if verdicts:
        counted = ("checks passed", "failed", "could not be run", "not applicable", "seconds")
        parts.append(rendered(Table([*texts("FMU", "verdict"), *numbers(*counted)], verdicts)))
    parts += without
    for heading, rows in (("not applicable because", skipped), ("verdict", failures)):
        if rows:
            parts.append(rendered(Table(texts("FMU", "scene", "quantity", heading), rows)))
    parts.append(provenance_markdown(provenance_of_all(validations)))
    return parts
