from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from studies.hosts.hosts import hosts, package_version, wine_version


def test_a_package_that_is_missing_is_named_with_what_installs_it() -> None:
    with pytest.raises(HarnessError, match=r"no-such-host: not installed.*`make hosts`"):
        package_version("no-such-host")


def test_an_environment_that_is_missing_is_named_with_what_creates_it(tmp_path: Path) -> None:
    (cofmupy,) = (host for host in hosts(tmp_path / "nowhere") if host.name == "cofmupy")
    with pytest.raises(HarnessError, match=r"cofmupy: there is no .*nowhere.*`make hosts`"):
        cofmupy.version()


def test_wine_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(HarnessError, match=r"wine: not found.*`make hosts`"):
        wine_version()
