"""What an installation brings along: the packages of the wheel, and those they require."""

from __future__ import annotations

import tomllib
from importlib.metadata import requires

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.processes import ROOT

BUILD_TOOLS = {
    *("cmake", "ninja", "meson", "meson-python", "scons", "scikit-build", "scikit-build-core"),
    *("ziglang", "clang", "gcc", "cython", "pythonfmu", "setuptools", "wheel", "pip"),
}


def installed_with(requirements: list[str]) -> set[str]:
    """Return the names of all packages that these requirements install here."""
    found: set[str] = set()
    todo = [Requirement(text) for text in requirements]
    while todo:
        requirement = todo.pop()
        name = canonicalize_name(requirement.name)
        extras = ["", *requirement.extras]
        if name in found or not needed(requirement, [""]):
            continue
        found.add(name)
        theirs = [Requirement(text) for text in requires(name) or []]
        todo += [one for one in theirs if needed(one, extras)]
    return found


def needed(requirement: Requirement, extras: list[str]) -> bool:
    marker = requirement.marker
    return marker is None or any(marker.evaluate({"extra": extra}) for extra in extras)


def test_the_wheel_installs_no_compiler_and_no_build_tool() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found = installed_with(project["dependencies"])
    assert "fmpy" in found
    assert "lxml" in found, "what fmpy requires is among them"
    assert not found & BUILD_TOOLS
