from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.scenes.scene_files import find_scene
from studies.mutants.native.change_verdict import ChangeVerdict, NativeRun
from studies.mutants.native.changes import (
    Change,
    hand_written_faults,
    harmless_variants,
)
from studies.mutants.native.native_run import run_changes
from studies.mutants.native.workshop import read_native_sources
from studies.mutants.trial_client import TrialServers

SCENES = ("less_than_a_period", "lugre_less_than_a_period", "averaged_less_than_a_period")
REJECTED = ("mean_before_first_period", "first_bristle_sign", "swing_sign")
SEEN_ELSEWHERE = "split_merges_mirror"
HARMLESS = ("shorter_arcs", "stops_without_drift")

ONCE_PASSED = {
    "averaged_lugre_reversed": ("table_mirror_of_negative",),
    "beside_lift_off": ("boundaries_to_1e_5",),
    "interface": (
        *("resonance_band_wide", "tolerance_negative", "read_before_start"),
        *("instance_first_host", "log_categories_ignored", "log_percent", "references_uncounted"),
    ),
    "overdamped": ("oscillator_near_critical",),
    "phases_beyond_pi": ("large_phase_off",),
    "ramps_averaged_block": ("time_to_stop",),
    "leap_chirp": ("leap_chirp_twice",),
    "leap_table_1": ("leap_counts_no_reversals",),
    "leap_outrun": ("leap_keeps_event_age",),
}
"""Scenes made for faults that all others accept."""


def named(*names: str) -> list[Change]:
    made = {change.name: change for change in (*hand_written_faults(), *harmless_variants())}
    return [made[name] for name in names]


@pytest.mark.slow
def test_faults_are_rejected_and_variants_accepted_and_verdicts_kept(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    changes = named(*REJECTED, SEEN_ELSEWHERE, *HARMLESS)
    files = [find_scene(scene) for scene in SCENES]
    journal = tmp_path / "verdicts"
    run = run_changes(native_fmu, changes, files, jobs=1, time_limit=30.0, journal=journal)
    rejected = {verdict.change.name for verdict in run.verdicts if verdict.rejected}
    assert rejected == set(REJECTED)
    assert [verdict.change.name for verdict in run.survivors] == [SEEN_ELSEWHERE]
    assert run.false_alarms == ()
    assert run.rate == 0.75
    assert all(verdict.quantity for verdict in run.verdicts if verdict.rejected)
    monkeypatch.delattr(TrialServers, "attempt")  # nothing is left to be tried
    again = run_changes(native_fmu, changes, files, jobs=1, time_limit=30.0, journal=journal)
    assert again.verdicts == run.verdicts


@pytest.mark.slow
def test_faults_that_once_passed_are_rejected_by_the_scenes_made_for_them(
    native_fmu: Path,
) -> None:
    changes = named(*(name for names in ONCE_PASSED.values() for name in names))
    files = [find_scene(scene) for scene in ONCE_PASSED]
    run = run_changes(native_fmu, changes, files, jobs=1, time_limit=30.0)
    assert [verdict.change.name for verdict in run.survivors] == []


def test_a_unit_includes_headers_of_headers(native_fmu: Path) -> None:
    sources = read_native_sources(native_fmu)
    assert "component/outputs.c" in sources.units_with("device/moment.h")
    assert "component/outputs.c" in sources.units_with("device/stops.h"), "by way of moment.h"
    assert sources.units_with("device/stick.c") == ["device/stick.c"]
    assert sources.model == "SliderResonator"


def test_explained_survivors_do_not_count_and_false_alarms_do() -> None:
    fault = Change("a", "a.c", "x", "y", "m")
    hidden = Change("b", "a.c", "x", "y", "m", survives="rounding")
    harmless = Change("c", "a.c", "x", "y", "m", harmless=True)
    verdicts = (
        ChangeVerdict(fault, True),
        ChangeVerdict(hidden, False),
        ChangeVerdict(harmless, True),
    )
    run = NativeRun("x.fmu", verdicts, 0.0)
    assert run.rate == 1.0
    assert [verdict.change.name for verdict in run.survivors] == ["b"]
    assert [verdict.change.name for verdict in run.false_alarms] == ["c"]
    assert NativeRun("x.fmu", (), 0.0).rate is None


def test_fmus_without_sources_and_changes_that_do_not_fit_are_refused(
    python_fmu: Path, native_fmu: Path
) -> None:
    with pytest.raises(FmuError, match="has no C sources to change"):
        read_native_sources(python_fmu)
    with pytest.raises(FmuError, match="no such file"):
        read_native_sources(Path("no.fmu"))
    stale = Change("stale", "device/stick.c", "no such text", "", "m")
    with pytest.raises(
        HarnessError, match=r"stale: 'no such text' occurs 0 times in device/stick\.c"
    ):
        run_changes(native_fmu, [stale], [], jobs=1, time_limit=1.0)
