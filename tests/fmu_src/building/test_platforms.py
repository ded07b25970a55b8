from __future__ import annotations

import platform
import sys

import pytest

from fmu_src.building.build_error import BuildError
from fmu_src.building.platforms import (
    AARCH64_LINUX,
    HOST,
    PLATFORMS,
    host_platform,
    platforms_named,
)


def test_no_names_stand_for_all() -> None:
    assert platforms_named([]) == list(PLATFORMS.values())


def test_fmi_3_has_a_name_for_arm_linux() -> None:
    assert platforms_named([], "3.0") == [*PLATFORMS.values(), AARCH64_LINUX]
    with pytest.raises(BuildError, match="'aarch64-linux' refused: must be one of linux64, win64"):
        platforms_named(["aarch64-linux"])


@pytest.mark.parametrize("machine", ["aarch64", "arm64"])
def test_arm_linux_is_a_host_of_fmi_3(monkeypatch: pytest.MonkeyPatch, machine: str) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(platform, "machine", lambda: machine)
    assert host_platform("3.0") == AARCH64_LINUX


def test_platforms_are_unique_and_in_table_order() -> None:
    names = [p.name for p in platforms_named(["win64", "linux64", "win64"])]
    assert names == ["linux64", "win64"]


def test_an_unknown_platform_is_refused_by_name() -> None:
    with pytest.raises(BuildError, match=r"platform 'amiga' refused: must be one of linux64,"):
        platforms_named(["linux64", "amiga"])


@pytest.mark.parametrize(
    ("system", "machine", "name"),
    [
        ("linux", "x86_64", "linux64"),
        ("win32", "AMD64", "win64"),
        ("darwin", "arm64", "darwin64"),
        ("darwin", "x86_64", "darwin64"),
        ("linux", "aarch64", None),
        ("sunos5", "sun4u", None),
        ("win32", "x86", None),
    ],
)
def test_the_host_is_recognised_or_refused(
    monkeypatch: pytest.MonkeyPatch, system: str, machine: str, name: str | None
) -> None:
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    if name:
        assert [host_platform()] == platforms_named([HOST]) == [PLATFORMS[name]]
    else:
        with pytest.raises(BuildError, match=f"no name for {system} on {machine}"):
            host_platform()
