"""The lock files hold what pyproject.toml asks for, so that an SBOM made of them is whole."""

import re
import tomllib
from importlib.metadata import requires

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.processes import ROOT

CONTENT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = CONTENT["project"]
WANTED = {
    "requirements.lock": sum(PROJECT["optional-dependencies"].values(), PROJECT["dependencies"]),
    "requirements-lint.lock": CONTENT["dependency-groups"]["lint"],
}


def locked(name: str) -> dict[str, set[str]]:
    """Return the versions of each package, several where they depend on the Python.

    No line names an index or a folder.
    """
    versions: dict[str, set[str]] = {}
    for line in (ROOT / name).read_text(encoding="utf-8").splitlines():
        assert "://" not in line, f"{name}: {line}"
        if line and not line.lstrip().startswith("#"):
            found = re.match(r"([A-Za-z0-9._-]+)==([^ ;]+)( ;.*)?$", line)
            assert found, f"{name}: {line}: must be a package, == and a version"
            versions.setdefault(canonicalize_name(found[1]), set()).add(found[2])
    return versions


@pytest.mark.parametrize("name", WANTED)
def test_every_requirement_is_locked_at_a_version_that_it_allows(name: str) -> None:
    versions = locked(name)
    for requirement in map(Requirement, WANTED[name]):
        if requirement.name == "slider-resonator":
            continue
        found = versions.get(canonicalize_name(requirement.name), set())
        assert found, f"{name} lacks {requirement.name}: `make lock` writes it anew"
        refused = [
            one for one in found if not requirement.specifier.contains(one, prereleases=True)
        ]
        assert not refused, f"{name}: {requirement.name} {refused}: must be {requirement.specifier}"


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
    found = installed_with(PROJECT["dependencies"])
    assert "fmpy" in found
    assert "lxml" in found, "what fmpy requires is among them"
    assert not found & BUILD_TOOLS
