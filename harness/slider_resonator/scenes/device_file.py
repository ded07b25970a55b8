"""Device files: a TOML table [device], values in SI units or as text with a unit."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from math import tau
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from slider_resonator.device.device import Device
from slider_resonator.device.interface import VARIABLES
from slider_resonator.errors import SceneError, unknown_name
from slider_resonator.scenes.schema import DeviceFileTable
from slider_resonator.scenes.table_reading import table_from
from slider_resonator.scenes.toml_file import read_toml, toml_value

_KINDS: Mapping[str, tuple[set[str], str]] = {
    "grid": ({"grid", "list", "random", "measures"}, "`slider-resonator sweep {0}`"),
    "scene": (
        {"run", "expect", "inputs", "tuning", "need", "sweep"},
        "`slider-resonator run {0}` or `validate --scene {0}`",
    ),
    "device": ({"device"}, "`slider-resonator device {0}`, or `--device {0}` of other commands"),
}
"""Keys by which a file is known as what it is, the first kind that has one; what it is for."""


def refuse_other_kinds(content: Mapping[str, Any], source: str, expected: str) -> None:
    """Raise SceneError for the content of a scene, grid or device file that is not `expected`."""
    found = next((kind for kind, (keys, _) in _KINDS.items() if content.keys() & keys), expected)
    if found != expected:
        use = _KINDS[found][1].format(source)
        must = "an FMU" if expected == "FMU" else f"a {expected} file"
        raise SceneError(f"{source}: is a {found} file; must be {must}. Use it in {use}")


def example_devices() -> dict[str, Path]:
    """Return the files of the devices to start from, by name, table 1 first."""
    folder = Path(str(resources.files("slider_resonator.scenes") / "devices"))
    files = sorted(folder.glob("*.toml"), key=lambda path: (path.stem != "table_1", path.stem))
    return {path.stem: path for path in files}


def find_device(name_or_file: str, folder: Path = Path()) -> Path:
    """Return the file of an example, or one in the folder; SceneError names the nearest example."""
    examples = example_devices()
    if name_or_file in examples:
        return examples[name_or_file]
    path = folder / name_or_file
    if not path.suffix and len(Path(name_or_file).parts) <= 1 and not path.exists():
        raise SceneError(
            f"{unknown_name('device', name_or_file, examples)}; or a device file, written by "
            "`slider-resonator device --example table_1 > device.toml`"
        )
    return path


@dataclass(frozen=True)
class DeviceFile:
    """What a device file says: `values` are the parameters that it states, in SI units.

    `slips` is a sentence for each value that may be meant in another unit.
    """

    path: Path
    title: str
    values: dict[str, float]
    slips: Sequence[str]


def read_device_file(name_or_file: str, folder: Path = Path()) -> DeviceFile:
    """Read a device file as `find_device` finds it; its title is by default what it is called.

    Raises SceneError with file, key, value and requirement.
    """
    path = find_device(name_or_file, folder)
    content = read_toml(path)
    refuse_other_kinds(content, str(path), "device")
    table = table_from(DeviceFileTable, content, str(path))
    slips = possible_slips(content["device"])
    return DeviceFile(path, table.title or name_or_file, table.device.stated, slips)


FREQUENCIES = ("drive_frequency", "resonator_frequency")
IN_ANOTHER_UNIT = (*FREQUENCIES, "phase")
"""What is often meant in Hz or degrees."""


def possible_slips(
    table: Mapping[str, Any], beside: Mapping[str, float] | None = None, where: str = ""
) -> list[str]:
    """Return a sentence for each plain number that may be meant in Hz, degrees or um.

    In Hz may be round numbers, what is beside one, and a frequency that is 2 pi times or a 2 pi-th
    of the other, which is that of `beside` if the table does not have it; in degrees a phase of
    more than a turn; in um an amplitude that is faster than 50 m/s. `where` says what to write,
    if not in [device].
    """

    def frequency(name: str) -> float:
        value = table.get(name, (beside or {}).get(name, VARIABLES[name].start))
        return VARIABLES[name].in_si(value) if isinstance(value, str) else float(value)

    numbers = {name: value for name, value in table.items() if isinstance(value, float | int)}
    given = [n for n in FREQUENCIES if n in numbers and numbers[n] != VARIABLES[n].start]
    drive, resonator = map(frequency, FREQUENCIES)
    apart = any(abs(r / tau - 1.0) < 0.03 for r in (drive / resonator, resonator / drive))
    is_round = any(float(f"{numbers[name]:.2g}") == numbers[name] for name in given)
    meant = {n: "Hz" for n in given if numbers[n] > 0.0 and (is_round or apart)}
    if numbers.get("base_amplitude", 0.0) * drive > 50.0:
        meant["base_amplitude"] = "um"
    if abs(numbers.get("phase", 0.0)) > tau:
        meant["phase"] = "deg"
    return [
        f"{name} = {numbers[name]:g} is in {VARIABLES[name].unit}, which is "
        f"{VARIABLES[name].shown(numbers[name])}; if {numbers[name]:g} {unit} is meant, write "
        + (where or f'{name} = "{numbers[name]:g} {unit}"')
        for name, unit in meant.items()
    ]


def without_drive(values: Mapping[str, float]) -> list[str]:
    """Return the sentence about a device (SI units) that no tangential force drives, if it is one.

    The base moves the slider by the resonator's inertia, which `resonator_mass` 0 has not.
    """
    device = Device.from_mapping(values)
    if device.tangential_force != 0.0 or device.resonator_mass * device.base_amplitude != 0.0:
        return []
    return [
        "nothing drives the slider: tangential_force = 0, base_amplitude = "
        f"{device.base_amplitude:g} and resonator_mass = {device.resonator_mass:g}; for motion, "
        "the first or both of the others must be above 0"
    ]


def to_ssv(device: Device, name: str) -> str:
    """Return the parameter set of a device (SSP 1.0, `.ssv`), which system simulators import."""
    space = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
    root = Element("ssv:ParameterSet", {"xmlns:ssv": space, "version": "1.0", "name": name})
    parameters = SubElement(root, "ssv:Parameters")
    for key, value in vars(device).items():
        parameter = SubElement(parameters, "ssv:Parameter", name=key)
        SubElement(parameter, f"ssv:{VARIABLES[key].kind}", value=repr(value))
    indent(root)
    return tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def to_toml(device: Device, title: str = "") -> str:
    """Return the text of a device file: what differs from table 1, and the number of faces."""
    lines = [f"title = {toml_value(title)}", ""] if title else []
    lines.append("[device]")
    for name, value in vars(device).items():
        if name in (*device.differing, "friction_faces"):
            unit = VARIABLES[name].unit
            said = "" if unit == "1" else f"  # {unit}, {VARIABLES[name].shown(value)}"
            lines.append(f"{name} = {value!r}{said}")
    return "\n".join(lines) + "\n"
