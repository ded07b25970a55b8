"""Modules that hosts run in their own environments need nothing of ours."""

from __future__ import annotations

import sys

import pytest

from tests.processes import ROOT, run_command

HOST_LIBRARIES = {"cofmupy", "ecospy", "fmpy", "fmuloader", "libcosimpy", "pathsim", "pathsim_fmi"}
"""What a host module may need beside the standard library: the simulator that it drives."""


@pytest.mark.parametrize(
    "module", sorted(p.stem for p in (ROOT / "harness" / "studies" / "hosts").glob("*_host.py"))
)
def test_host_module_needs_only_its_host(module: str) -> None:
    """A foreign environment has the simulator and the standard library, but not our packages."""
    name = f"studies.hosts.{module}"
    code = f"import sys; sys.path.insert(0, sys.argv[1]); import {name}"
    result = run_command(sys.executable, "-I", "-S", "-c", code, ROOT / "harness")
    missing = result.stderr.strip().rpartition("No module named ")[2].strip("'").partition(".")[0]
    assert result.returncode == 0 or missing in HOST_LIBRARIES, result.stderr
