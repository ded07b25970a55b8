"""The hosts, where each is found, and which FMUs it can load."""

import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from slider_resonator.errors import HarnessError
from studies.hosts.compiler import compiler_version, native_compiler, zig_compiler

OWN_ENVIRONMENTS = Path(".venv-hosts")
"""Where `make hosts` puts an environment each for CoFmuPy, which pins old versions of fmpy and
pythonfmu, and for the newest fmpy with pathsim-fmi: the harness itself does without the cmake that
fmpy installs since 0.3.26."""

INSTALL = "`make hosts` installs it"


@dataclass(frozen=True)
class Host:
    """A simulator, run as `python -m studies.hosts.MODULE`.

    `version` raises HarnessError where the host is missing. `loads_python` is whether it can
    load an FMU that needs Python in the process, `loads_fmi_3` whether it can load one of FMI 3.0,
    `couples` whether it runs the native FMU behind the Python one.
    """

    name: str
    module: str
    version: Callable[[], str]
    python: Path = Path(sys.executable)
    loads_python: bool = True
    loads_fmi_3: bool = False
    couples: bool = False


def package_version(package: str, python: Path = Path(sys.executable)) -> str:
    """Return the version of a package in the environment of `python`.

    Raises HarnessError where the environment or the package is missing.
    """
    if not python.is_file():
        raise HarnessError(f"{package}: there is no {python}; {INSTALL}")
    question = f"from importlib.metadata import version; print(version({package!r}))"
    answer = subprocess.run([python, "-c", question], capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise HarnessError(f"{package}: not installed beside {python}; {INSTALL}")
    return answer.stdout.strip()


def packaged(
    name: str, module: str, package: str, python: Path = Path(sys.executable), **able: bool
) -> Host:
    """Return a host whose version is that of a package in the environment of `python`."""
    return Host(name, module, partial(package_version, package, python), python, **able)


def native_version() -> str:
    """Return the version of the C compiler for this machine; HarnessError where there is none."""
    return compiler_version(native_compiler())


def wine_version() -> str:
    """Return the versions of ziglang and Wine; HarnessError where either is missing."""
    if shutil.which("wine") is None:
        raise HarnessError(f"wine: not found; {INSTALL} where it may call apt-get")
    answer = subprocess.run(["wine", "--version"], capture_output=True, text=True, check=False)
    wine = answer.stdout.split()[0].removeprefix("wine-") if answer.stdout else "of unknown version"
    return f"{compiler_version(zig_compiler())}, Wine {wine}"


def hosts(own_environments: Path = OWN_ENVIRONMENTS) -> tuple[Host, ...]:
    """Return all hosts, the one that others are compared with first."""
    scripts = "Scripts" if sys.platform == "win32" else "bin"
    cofmupy, newest = (own_environments / name / scripts / "python" for name in ("cofmupy", "fmpy"))
    return (
        packaged("fmpy", "fmpy_host", "fmpy", loads_fmi_3=True),
        packaged("newest fmpy", "fmpy_host", "fmpy", newest, loads_fmi_3=True),
        packaged("ecos", "ecos_host", "ecospy", loads_fmi_3=True),
        packaged("libcosimpy", "libcosim_host", "libcosimpy"),
        packaged("pathsim-fmi", "pathsim_host", "pathsim-fmi", newest),
        packaged("cofmupy", "cofmupy_host", "cofmupy", cofmupy),
        # It needs the functions of model exchange, which pythonfmu lacks.
        packaged("fmuloader", "fmuloader_host", "fmuloader", loads_python=False),
        packaged(
            "fmu_manipulation_toolbox",
            "container_host",
            "fmu-manipulation-toolbox",
            loads_python=False,
            couples=True,
        ),
        Host("C driver", "driver_host", native_version, loads_python=False),
        Host("C driver in Wine", "wine_host", wine_version, loads_python=False),
    )
