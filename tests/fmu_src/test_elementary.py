"""The component's elementary functions: as accurate as those of a library, and used throughout."""

import ctypes
import math
import re
from collections.abc import Callable

import numpy as np
import pytest

from fmu_src.sources import C_SOURCES

ACCURATE = 4.0
"""Error in units in the last place of the value, or for sine and cosine of 1."""

RANGES: dict[str, tuple[Callable[[float], float], list[tuple[float, float]]]] = {
    "sin": (math.sin, [(-8.0, 8.0), (-1e-3, 1e-3), (-1e6, 1e6), (-1e9, 1e9)]),
    "cos": (math.cos, [(-8.0, 8.0), (-1e-3, 1e-3), (-1e6, 1e6), (-1e9, 1e9)]),
    "asin": (math.asin, [(-1.0, 1.0), (0.499, 0.501), (0.99, 1.0)]),
    "acos": (math.acos, [(-1.0, 1.0), (0.499, 0.501), (0.99, 1.0)]),
    "exp": (math.exp, [(-1.0, 1.0), (-745.0, 709.7)]),
    "expm1": (math.expm1, [(-1.0, 1.0), (-1e-3, 1e-3), (-745.0, 709.7)]),
    "log": (math.log, [(1e-3, 3.0), (0.99, 1.01), (1.0, 1e9), (1e-310, 1e-300), (1e300, 1e308)]),
    "sine": (math.sin, [(-8.0, 8.0), (-1e6, 1e6), (-1e9, 1e9)]),
    "cosine": (math.cos, [(-8.0, 8.0), (-1e6, 1e6), (-1e9, 1e9)]),
}
"""In the order of the probe."""
NUMBERS = {name: number for number, name in enumerate(RANGES)}


@pytest.fixture(scope="module")
def library(native_library: ctypes.CDLL) -> ctypes.CDLL:
    found = native_library
    found.probe_elementary.restype = ctypes.c_double
    found.probe_elementary.argtypes = [ctypes.c_int, ctypes.c_double]
    for name in ("elementary_atan2", "elementary_hypot"):
        function = getattr(found, name)
        function.restype = ctypes.c_double
        function.argtypes = [ctypes.c_double, ctypes.c_double]
    return found


def assert_accurate(found: float, expected: float, scale: float, what: str) -> None:
    error = abs(found - expected) / math.ulp(scale)
    assert error <= ACCURATE, f"{what} = {found!r}, {error:.1f} units from {expected!r}"


@pytest.mark.parametrize("name", RANGES)
def test_values_are_those_of_the_library(library: ctypes.CDLL, name: str) -> None:
    function, ranges = RANGES[name]
    number = NUMBERS[name]
    for low, high in ranges:
        for x in np.random.default_rng(1).uniform(low, high, 5000).tolist():
            expected = function(x)
            turns = function in (math.sin, math.cos)
            scale = 1.0 if turns and abs(x) > 1.0 else expected
            assert_accurate(library.probe_elementary(number, x), expected, scale, f"{name}({x!r})")


@pytest.mark.parametrize("name", RANGES)
def test_special_values_are_those_of_the_library(library: ctypes.CDLL, name: str) -> None:
    function, number = RANGES[name][0], NUMBERS[name]
    for x in (0.0, 1.0, math.inf, -math.inf, math.nan, 1e300, -1e300, 5e-324):
        found = library.probe_elementary(number, x)
        try:
            expected = function(x)
        except OverflowError:
            expected = math.inf
        except ValueError:
            expected = -math.inf if name == "log" and x == 0.0 else math.nan
        if math.isnan(expected):
            assert math.isnan(found), f"{name}({x!r})"
        else:
            assert found == pytest.approx(expected, rel=1e-15, abs=0.0), f"{name}({x!r})"


def test_functions_of_two_numbers(library: ctypes.CDLL) -> None:
    random = np.random.default_rng(2)
    values = random.standard_normal((5000, 2)) * 10.0 ** random.integers(-3, 4, (5000, 2))
    for y, x in [*values.tolist(), (0.0, 1.0), (0.0, -1.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 0.0)]:
        angle, length = math.atan2(y, x), math.hypot(y, x)
        assert_accurate(library.elementary_atan2(y, x), angle, angle, f"atan2({y!r}, {x!r})")
        assert_accurate(library.elementary_hypot(y, x), length, length, f"hypot({y!r}, {x!r})")
    assert library.elementary_hypot(3e200, 4e200) == pytest.approx(5e200, rel=1e-15)
    assert library.elementary_hypot(3e-200, 4e-200) == pytest.approx(5e-200, rel=1e-15)


DIFFER = re.compile(r"(?<![\w.>])(sin|cos|tan|a(?:sin|cos|tan2?)|hypot|exp|expm1|log|log1p|pow)\(")
"""Functions of <math.h> that are not the same on every platform."""


def test_no_file_uses_the_functions_of_the_platform() -> None:
    files = [p for p in C_SOURCES.rglob("*.[ch]") if not p.name.startswith("elementary")]
    assert len(files) > 100
    for path in files:
        code = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        if used := DIFFER.search(code):
            assert re.search(r'#include "[./\w]*\belementary\.h"', code), (
                f"{path.name} uses {used[1]} of the platform"
            )
            assert path.suffix == ".c", f"{path.name}: macros of a header reach other files"
