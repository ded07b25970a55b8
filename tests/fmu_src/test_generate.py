import re
from pathlib import Path

import pytest

from fmu_src.building.c_sources import FMI_HEADERS, controller_sources, slider_sources
from fmu_src.generate import main
from fmu_src.generators.parameters import python_parameters
from fmu_src.generators.refusal_texts import c_function
from fmu_src.generators.variable_table import c_table
from fmu_src.python.slider_component import constants
from fmu_src.python.slider_component.variables import VARIABLES
from fmu_src.sources import PACKAGE

CODE = slider_sources()


def test_the_committed_file_is_current() -> None:
    assert (PACKAGE / "parameters.py").read_text() == python_parameters(VARIABLES), (
        "parameters.py is out of date: `python -m fmu_src.generate` writes it again"
    )


def test_a_folder_gets_all_sources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["generate", str(tmp_path)])
    main()
    sources = {
        "slider": CODE,
        "slider_3": slider_sources("3.0"),
        "controller": controller_sources(),
    }
    found = {str(p.relative_to(tmp_path)): p.read_text() for p in tmp_path.rglob("*.[ch]")}
    assert found == {
        f"{k}/{name}": text for k, code in sources.items() for name, text in code.items()
    }


def test_the_headers_of_fmi_are_whole_and_have_unix_line_ends() -> None:
    for version, names in FMI_HEADERS.items():
        code = slider_sources(version)
        for name in names:
            (text,) = (text for path, text in code.items() if path.endswith(name))
            assert "Modelica Association" in text
            assert "\r" not in text


def test_the_table_of_c_has_all_variables_in_their_order() -> None:
    """Scenes try each start value and bound."""
    names = [variable.name for variable in VARIABLES]
    found = re.findall(r"VR_(\w+) = (\d+),", CODE["component/variables.h"])
    assert found == [(name.upper(), str(i)) for i, name in enumerate(names)]
    assert re.findall(r'^    \{"(\w+)",', CODE["component/variables.c"], re.MULTILINE) == names


def test_constants_read_back_exactly() -> None:
    found = re.findall(r"^#define ([A-Z_]+) (\S+)$", CODE["base/constants.h"], re.MULTILINE)
    in_python = {name: value for name, value in vars(constants).items() if name.isupper()}
    assert {name: float(text) for name, text in found} == in_python


def test_a_refusal_in_c_takes_its_arguments_in_the_order_of_the_text() -> None:
    text = c_function("OUT_OF_STOCK", "{count:d} {name}: {value!r} is 100 % over {found}")
    assert "refuse_out_of_stock(Refusal *refusal, long long count, const char *name, " in text
    assert "double value, const char *found) {\n    char value_text[NUMBER_SIZE];\n" in text
    assert "%lld %s: %s is 100 %% over %s" in text
    assert "count, name, number_text(value, value_text), found);\n}" in text


@pytest.mark.parametrize("text", ["{count:d} and {count:d}", "{value:.3f}", "{name!s}"])
def test_a_refusal_must_show_each_argument_once_in_a_form_that_c_has(text: str) -> None:
    with pytest.raises(ValueError, match="once, as text, by !r or by :d"):
        c_function("OUT_OF_STOCK", text)


def test_outputs_must_come_last() -> None:
    with pytest.raises(ValueError, match="outputs must come last"):
        c_table(tuple(reversed(VARIABLES)), "")
