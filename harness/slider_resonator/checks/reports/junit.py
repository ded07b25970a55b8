"""Verdicts as JUnit XML, the format that CI servers read."""

import re
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from slider_resonator.checks.validate import RunFailure, Validation, provenance_of_all
from slider_resonator.checks.verdict import TITLE, place, sentence, title
from slider_resonator.fmu.provenance import Provenance, provenance_properties
from slider_resonator.output.atomic import replacing

_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML 1.0 cannot hold: an FMU may have printed them."""


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
    for name in ("tests", "failures", "errors", "skipped"):
        root.set(name, str(sum(int(suite.attrib[name]) for suite in root)))
    root.set("time", f"{sum(v.wall_time for v in validations):.3f}")
    ET.indent(root)
    with replacing(path) as temporary:
        ET.ElementTree(root).write(temporary, encoding="utf-8", xml_declaration=True)


def _suite(root: ET.Element, validation: Validation, provenance: Provenance) -> None:
    suite = ET.SubElement(
        root,
        "testsuite",
        name=_text(validation.fmu),
        tests=str(
            len(validation.checks) + len(validation.run_failures) + len(validation.not_applied)
        ),
        failures=str(len(validation.failed)),
        errors=str(len(validation.run_failures)),
        skipped=str(len(validation.not_applied)),
        time=f"{validation.wall_time:.3f}",
    )
    facts = {"judged": validation.without} if validation.without else {}
    facts |= provenance_properties(provenance, validation.identity)
    properties = ET.SubElement(suite, "properties")
    for name, value in facts.items():
        ET.SubElement(properties, "property", name=name, value=_text(value))
    for scene, quantity, reason in validation.inapplicable:
        case = ET.SubElement(suite, "testcase", classname=scene, name=quantity)
        ET.SubElement(case, "skipped", message=_text(f"not applicable: {reason}"))
    for check in validation.checks:
        case = ET.SubElement(suite, "testcase", classname=check.scene, name=_text(title(check)))
        if not check.passed:
            failure = ET.SubElement(case, "failure", message=_text(sentence(check)))
            failure.text = _text(f"{sentence(check)}\nexpected because: {check.why}")
    for run_failure in validation.run_failures:
        name = f"could not be run{place(run_failure.at, ' at ')}"
        case = ET.SubElement(suite, "testcase", classname=run_failure.scene or "FMU", name=name)
        ET.SubElement(case, "error", message=_text(run_failure.reason)).text = _text(
            run_failure.reason
        )


def _text(text: str) -> str:
    return _NOT_XML.sub("\ufffd", text)
