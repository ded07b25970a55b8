"""Verdicts as one JSON document."""

from collections.abc import Sequence
from pathlib import Path

from slider_resonator.checks.validate import Validation, provenance_of_all
from slider_resonator.checks.verdict import measure_of, sentence
from slider_resonator.output.atomic import replacing
from slider_resonator.output.json_output import to_json


def validations_as_json(validations: Sequence[Validation], error: str = "") -> str:
    """Return the verdicts on a single FMU directly, those on several under `fmus`.

    An `error` that stopped the command before it reached an FMU is returned alone.
    """
    provenance = provenance_of_all(validations)
    plain = [_plain(validation) for validation in validations]
    if error:
        return to_json({"passed": False, "error": error}, provenance)
    if len(plain) == 1:
        return to_json(plain[0], provenance)
    passed = all(validation.passed for validation in validations)
    return to_json({"passed": passed, "fmus": plain}, provenance)


def write_json(path: Path, validations: Sequence[Validation], error: str = "") -> None:
    """Write that document; HarnessError when the file cannot be written."""
    with replacing(path) as temporary:
        temporary.write_text(validations_as_json(validations, error) + "\n", encoding="utf-8")


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
