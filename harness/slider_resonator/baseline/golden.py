"""The golden results of an FMU in a scene: measured, compared with later ones, kept in files."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from slider_resonator.checks.compare import Comparison, Value
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measuring import Measurement, measure
from slider_resonator.checks.validate import Judged
from slider_resonator.errors import HarnessError, SceneError, explained, unknown_name
from slider_resonator.output.files import make_folder, write_csv
from slider_resonator.scenes.csv_signal import csv_rows
from slider_resonator.scenes.scene import ScenePoint
from slider_resonator.scenes.vocabulary import QUANTITIES

SIGNALS = (
    *("position", "velocity", "resonator_displacement", "resonator_velocity"),
    *("normal_force", "friction_force", "contact_mode", "event_times"),
)
"""Signals kept at some points of a run; `event_times` is the last event before each."""
OF_A_RUN = (
    *("mean_velocity", "stick_fraction", "reversals", "ripple_amplitude", "ripple_frequency"),
)
"""Numbers kept of a run as a whole, or of its last drive periods."""
OF_CONSTANT_INPUTS = (
    *("steady_status", "steady_velocity", "predicted_velocity"),
    *("blocking_status", "blocking_force", "predicted_blocking_force"),
)
"""Numbers and words found by shooting, and predicted by the FMU."""
NUMBERS_AND_WORDS = (*OF_CONSTANT_INPUTS, *OF_A_RUN)
"""All recorded quantities besides the signals, in the order of the files."""

THE_RUN = "the run"
"""In place of all of them where they do not apply to an FMU."""

Golden = Mapping[str, Measurement]
"""Quantity to its measurement; signals at few points."""


def measure_golden(fmu: FmuSide) -> Golden:
    """Measure all quantities that the scene allows: a ripple needs enough points per period.

    There is `THE_RUN` alone where the FMU cannot run the scene. Raises FmuError and Refusal as it
    does.
    """
    found = {}
    names = [*SIGNALS, *OF_A_RUN] if fmu.scene.stop_time is not None else []
    if all(signal.times == (0.0,) for signal in fmu.scene.signals.values()):
        names += OF_CONSTANT_INPUTS
    for name in names:
        try:
            measured = measure(name, fmu)
        except SceneError:
            continue
        if not measured.applicable:
            return {THE_RUN: measured}
        if name in SIGNALS:
            assert measured.times is not None
            count = len(measured.times)
            kept = np.rint(np.linspace(0, count - 1, min(count, 48))).astype(int)
            measured = replace(measured, value=measured.value[kept], times=measured.times[kept])
        found[name] = measured
    if "ripple_amplitude" not in found:  # too few points to see a ripple
        found.pop("ripple_frequency", None)
    return found


TOLERANCE = 1e-8
"""Relative change that passes: other platforms and compilers round differently."""
AGAINST = "baseline"


def compare_golden(
    point: ScenePoint, golden: Golden, now: Golden, tolerance: float
) -> Iterator[Judged]:
    """Yield every quantity that was recorded or exists now, and how it is compared.

    Numbers may change by `tolerance` times their size, signals by that share of their peak, times
    of events by that share of a drive period; counts, words and contact modes must be equal. Raises
    SceneError where the run has other points.
    """
    for name in [one for one in (*NUMBERS_AND_WORDS, *SIGNALS) if one in {*golden, *now}]:
        recorded = golden.get(name, Measurement(None, "it was not recorded"))
        measured = now.get(name, Measurement(None, "the scene no longer allows it"))
        if name in SIGNALS and not _same_points(recorded, measured):
            raise SceneError(
                f"{point.scene.source}: the run of {point.scene.name} has other points than when "
                "it was recorded; record it again with --replace"
            )
        quantity = QUANTITIES[name]
        comparison = Comparison(name, AGAINST, "the recorded result", may_lack=True)
        if quantity.in_periods:
            comparison = replace(comparison, tube=tolerance)
        elif not quantity.exact:
            comparison = replace(comparison, relative=tolerance)
        yield comparison, measured, recorded.value


def _same_points(one: Measurement, other: Measurement) -> bool:
    if one.times is None or other.times is None:
        return False
    same = one.times.shape == other.times.shape
    return same and bool(np.allclose(one.times, other.times, rtol=1e-9, atol=0.0))


NUMBERS, TRAJECTORY, PROVENANCE = "numbers.csv", "trajectory.csv", "provenance.csv"
DIGITS = 13
"""Significant digits in the files: further digits depend on the sine of the platform."""
NONE = "none"
"""Written for a quantity that does not exist, such as the velocity of a slow beat."""
HEADERS: Mapping[str, Sequence[str]] = {
    NUMBERS: ("at", "quantity", "unit", "value"),
    TRAJECTORY: ("at", "time", *SIGNALS),
    PROVENANCE: ("what", "value"),
}
"""First line of each file."""

T = TypeVar("T")
At = tuple[tuple[str, float], ...]
"""What a sweep has varied, () without a sweep."""


@dataclass(frozen=True)
class Recorded:
    """Golden results at every point of a scene's sweep; provenance in the order of its file."""

    points: Mapping[At, Golden]
    provenance: Mapping[str, str]


def key(at: Mapping[str, float]) -> At:
    """Return the point of a sweep as a key."""
    return tuple(sorted(at.items()))


def write_recorded(folder: Path, recorded: Recorded) -> None:
    """Write the files of a scene in place of earlier ones.

    That of the provenance, without which a scene is not recorded, is removed first and written
    last. Raises HarnessError when the folder cannot be written.
    """
    make_folder(folder)
    with explained(f"{folder}: cannot be written: ", HarnessError):
        (folder / PROVENANCE).unlink(missing_ok=True)
        (folder / TRAJECTORY).unlink(missing_ok=True)
    for name, rows in _tables(recorded).items():
        if rows or name != TRAJECTORY:
            write_csv(folder / name, HEADERS[name], rows)


def read_recorded(folder: Path) -> Recorded:
    """Read the files of a scene; HarnessError names the file and the line that is no record."""
    points: dict[At, dict[str, Measurement]] = {}
    numbers = _read(folder / NUMBERS, lambda row: (_at(row[0]), row[1], _value(row[1], row[3])))
    for at, name, value in numbers:
        points.setdefault(at, {})[name] = Measurement(value)
    columns: dict[At, list[list[float]]] = {}
    path = folder / TRAJECTORY
    lines = _read(path, lambda row: (_at(row[0]), [*map(_number, row[1:])]))
    for at, row in lines if path.exists() else ():
        columns.setdefault(at, []).append(row)
    for at, rows in columns.items():
        times, *signals = np.array(rows).T
        points.setdefault(at, {}).update(
            {name: Measurement(s, times=times) for name, s in zip(SIGNALS, signals, strict=True)}
        )
    return Recorded(points, dict(_read(folder / PROVENANCE, lambda row: (row[0], row[1]))))


def recorded_scenes(folder: Path) -> list[Path]:
    """Return the folders of the scenes that are recorded, in alphabetical order."""
    return sorted(path.parent for path in folder.glob(f"*/{PROVENANCE}"))


def _tables(recorded: Recorded) -> dict[str, list[Sequence[str]]]:
    """Return the rows of each file."""
    numbers: list[Sequence[str]] = []
    trajectory: list[Sequence[str]] = []
    for at, golden in recorded.points.items():
        place = " ".join(f"{name}={value!r}" for name, value in at)
        for name in NUMBERS_AND_WORDS:
            if name in golden:
                numbers.append((place, name, QUANTITIES[name].unit, _text(golden[name].value)))
        if signals := [golden[name] for name in SIGNALS if name in golden]:
            columns = [signals[0].times, *(signal.value for signal in signals)]
            trajectory += [(place, *map(_text, row)) for row in zip(*columns, strict=True)]
    origin: list[Sequence[str]] = [*recorded.provenance.items()]
    return {NUMBERS: numbers, TRAJECTORY: trajectory, PROVENANCE: origin}


def _read(path: Path, parsed: Callable[[list[str]], T]) -> Iterator[T]:
    """Yield the parsed cells of each line after the header; HarnessError with file and line."""
    header = list(HEADERS[path.name])
    with explained(kind=HarnessError):
        found, rows = csv_rows(path)
    if found != header:
        raise HarnessError(f"{path} line 1: {','.join(found)!r}; must be {','.join(header)!r}")
    for line, row in rows:
        with explained(f"{path} line {line}: ", HarnessError):
            if len(row) != len(header):
                raise ValueError(f"{len(row)} cells; must be {len(header)}")
            yield parsed(row)


def _text(value: Value) -> str:
    if value is None:
        return NONE
    return value if isinstance(value, str) else f"{value + 0.0:.{DIGITS}g}"  # no minus zero


def _value(name: str, text: str) -> Value:
    if name not in NUMBERS_AND_WORDS:
        raise ValueError(unknown_name("quantity", name, NUMBERS_AND_WORDS))
    if text == NONE:
        return None
    return text if QUANTITIES[name].kind == "word" else _number(text)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"{text!r}: must be a number") from None


def _at(text: str) -> At:
    pairs = (part.partition("=") for part in text.split())
    return tuple((name, _number(value)) for name, _, value in pairs)
