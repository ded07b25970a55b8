import os
import platform
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from fmpy import extract, simulate_fmu

from fmu_src.building.build_error import BuildError
from fmu_src.building.c_sources import FmiVersion, controller_sources, slider_sources, write_sources
from fmu_src.building.compiling import FLAGS, Compiler, default_compiler
from fmu_src.building.native_fmu import build_native
from fmu_src.building.platforms import HOST, host_platform
from fmu_src.sources import C_SOURCES, CONTROLLER_SOURCES
from studies.mutants.archive import files_in
from tests.processes import run_command

# Those of this machine, each once; the build's own is always there.
_FOUND = {os.path.realpath(p): n for n in ("clang", "gcc", "cc") if (p := shutil.which(n))}
COMPILERS = sorted(_FOUND.values())
WARNINGS = (
    *("-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"),
    "-Wno-enum-float-conversion",  # counts are enumeration constants, and exact as numbers
)
"""With -Wno-strict-prototypes for FMI 3.0, whose header declares functions without parameters."""
BINARY = host_platform().binary("SliderResonator")


def guid(fmu: Path) -> str:
    return ET.fromstring(files_in(fmu)["modelDescription.xml"]).attrib["guid"]


@pytest.fixture
def code() -> dict[str, str]:
    """The C sources, to be edited."""
    return slider_sources()


def test_another_content_gets_another_guid(
    native_fmu: Path, tmp_path: Path, code: dict[str, str]
) -> None:
    messages: list[str] = []
    code["component/values.c"] += "/* one comment more */\n"
    other = build_native(tmp_path, platforms=[HOST], code=code, progress=messages.append)
    assert guid(other) != guid(native_fmu), "hosts and states must tell builds apart"
    assert f"compiling for {host_platform().name} with ziglang" in messages[0]


def test_the_guid_is_in_the_sources_and_in_the_binary(native_fmu: Path) -> None:
    inside = files_in(native_fmu)
    for name in ("sources/component/model_guid.h", BINARY):
        assert inside[name].count(guid(native_fmu).encode()) == 1, name


@pytest.mark.parametrize(
    ("fmu", "document", "tag", "version"),
    [
        ("native", "modelDescription.xml", "CoSimulation/SourceFiles/File", "2.0"),
        ("native_3", "sources/buildDescription.xml", "BuildConfiguration/SourceFileSet/*", "3.0"),
    ],
    indirect=["fmu"],
)
def test_every_source_is_inside_and_listed(
    fmu: Path, document: str, tag: str, version: FmiVersion
) -> None:
    code, archive = slider_sources(version), files_in(fmu)
    other_shell = "fmi3" if version == "2.0" else "fmi2"
    paths = [p.relative_to(C_SOURCES) for p in C_SOURCES.rglob("*.[ch]")]
    assert {str(p) for p in paths if not p.name.startswith(other_shell)} < code.keys()
    inside = {n.removeprefix("sources/") for n in archive if n.startswith("sources/")}
    assert inside - {"buildDescription.xml"} == code.keys()
    listed = [e.get("name") for e in ET.fromstring(archive[document]).iterfind(tag)]
    assert listed == sorted(name for name in code if name.endswith(".c"))


@pytest.mark.parametrize(
    "compiler",
    [*(Compiler((c,), c, crosses=False) for c in COMPILERS), default_compiler()],
    ids=lambda c: c.description,
)
@pytest.mark.parametrize(
    "fmu",
    [*(pytest.param(n, marks=pytest.mark.slow) for n in ("native", "native_3")), "controller"],
    indirect=True,
    scope="session",
)
def test_sources_compile_alone_without_a_warning(
    fmu: Path, tmp_path: Path, compiler: Compiler
) -> None:
    extract(fmu, str(tmp_path))
    target = ["-target", host_platform().targets[0]] if compiler.crosses else []
    files = sorted((tmp_path / "sources").rglob("*.c"))
    warnings = [*WARNINGS, "-Wno-strict-prototypes"] if fmu.stem.endswith("3") else WARNINGS
    command = [*compiler.command, *target, *FLAGS, *warnings, "-o", "alone.so", *files, "-lm"]
    done = run_command(*command, cwd=tmp_path)
    assert done.returncode == 0, done.stderr


@pytest.fixture
def written_sources(tmp_path: Path) -> Path:
    """A folder with all C sources of the slider."""
    folder = tmp_path / "c"
    write_sources(slider_sources(), folder)
    return folder


@pytest.mark.parametrize("flag", ["-ffast-math", "-ffinite-math-only"])
def test_options_that_remove_the_checks_for_nan_do_not_compile(
    flag: str, written_sources: Path
) -> None:
    command = [*default_compiler().command, "-std=c99", "-c", "component/values.c"]
    assert run_command(*command, cwd=written_sources).returncode == 0
    done = run_command(*command, flag, cwd=written_sources)
    assert done.returncode != 0
    assert "compile without -ffast-math" in done.stderr


X87_RUN = """
#include <stdio.h>
#include "device/contact.h"
int main(void) {
    Plant plant = {.normal_frequency = 1.0, .window = {true, 0.0, TAU}};
    printf("%d %g", is_lifted(&plant, 0.0), time_to_switch(&plant, 0.0, true));
    return 0;
}
"""


@pytest.mark.skipif(
    shutil.which("gcc") is None or platform.machine() not in ("x86_64", "AMD64"),
    reason="needs gcc for x87",
)
def test_a_contact_without_load_stays_lifted_in_extended_precision(written_sources: Path) -> None:
    """Constants of more digits than a double must not end a flight that has no end."""
    (written_sources / "run.c").write_text(X87_RUN, encoding="utf-8")
    flags = ("-std=c99", "-O1", "-mfpmath=387")
    files = ("run.c", "device/contact.c")
    command = ["gcc", *flags, *files, "-o", "run", "-lm"]
    subprocess.run(command, cwd=written_sources, check=True)
    assert run_command(written_sources / "run").stdout == "1 inf"


def test_static_initializers_are_constants_for_every_compiler() -> None:
    """For some, as tcc, INFINITY and HUGE_VAL with a sign are none."""
    for sources in (slider_sources(), controller_sources()):
        assert not re.search("INFINITY|HUGE_VAL", sources["component/variables.c"])


@pytest.mark.slow
@pytest.mark.parametrize("compiler", COMPILERS)
def test_a_compiler_of_the_user_gives_the_same_motion(
    native_fmu: Path, tmp_path: Path, compiler: str
) -> None:
    own = build_native(tmp_path, compiler=compiler)
    assert [n for n in files_in(own) if n.startswith("binaries/")] == [BINARY]
    theirs, ours = (simulate_fmu(str(f), stop_time=0.05)["position"] for f in (own, native_fmu))
    assert theirs == pytest.approx(ours, rel=1e-11, abs=1e-11 * max(abs(ours)))


def test_a_compiler_for_another_platform_is_refused(tmp_path: Path) -> None:
    other = "win64" if host_platform().name != "win64" else "linux64"
    with pytest.raises(BuildError, match=f"refused for {other}: must be {host_platform().name}"):
        build_native(tmp_path / "dist", platforms=[other], compiler=sys.executable)
    assert not (tmp_path / "dist").exists()


@pytest.mark.parametrize(
    ("file", "text", "said"),
    [
        ("component/values.c", "#error broken on purpose\n", "broken on purpose"),
        ("friction/system.c", "int nothing;\n", "system_after"),
    ],
    ids=["message of the compiler", "function that is missing"],
)
def test_sources_that_make_no_library_are_refused(
    tmp_path: Path, code: dict[str, str], file: str, text: str, said: str
) -> None:
    with pytest.raises(BuildError, match=said):
        build_native(tmp_path / "dist", platforms=[HOST], code=code | {file: text})
    assert not (tmp_path / "dist").exists()


def test_fmi_functions_are_shared_and_the_model_is_not(controller_fmu: Path) -> None:
    slider, own = slider_sources(), set()
    for name, data in files_in(controller_fmu).items():
        source = name.removeprefix("sources/")
        if source != name and data.decode() != slider.get(source):
            own.add(source)
        assert source not in ("friction/coulomb.c", "friction/system.c", "device/device.h")
    generated = {"component/model_guid.h", "component/variables.c", "component/variables.h"}
    assert own == generated | {
        str(path.relative_to(CONTROLLER_SOURCES)) for path in CONTROLLER_SOURCES.rglob("*.[ch]")
    }
