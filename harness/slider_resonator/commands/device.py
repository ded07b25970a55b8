"""`device`: examples of device files, and what such a file means."""

from pathlib import Path

import click

from slider_resonator.commands.options import json_option, target
from slider_resonator.device.device import Device
from slider_resonator.device.interface import VARIABLES
from slider_resonator.output.console import print_result
from slider_resonator.output.files import distinct, write_text
from slider_resonator.output.readable import escaped, number_of, one_line
from slider_resonator.output.table import Table, numbers, texts
from slider_resonator.scenes import device_file
from slider_resonator.scenes.key_table import PARAMETER_MEANINGS


@click.command("device")
@click.argument("device", metavar="[NAME|FILE]", required=False)
@click.option("--example", metavar="NAME", help="Print an example, to start a file of your own.")
@click.option(
    "--ssv",
    type=target([".ssv"]),
    help="Write all parameters as a parameter set of SSP, for the FMU in a system simulator.",
)
@json_option
def device_command(
    device: str | None, example: str | None, ssv: Path | None, as_json: bool
) -> None:
    """Say what a device file means, or list the devices to start from.

    A device file has a table [device]: parameters of the FMU in SI units, or as text with a unit,
    such as "20 kHz", "1 um" or "5 g". What it leaves out keeps the value of table 1. Other commands
    take it with --device FILE.

    \b
    Examples:
      slider-resonator device
      slider-resonator device --example ultrasonic_slider > mine.toml
      slider-resonator device mine.toml
      slider-resonator device mine.toml --ssv mine.ssv
      slider-resonator steady --device mine.toml --set phase="30 deg"
    """
    if device is not None and example is not None:
        raise click.UsageError(f"{device} and --example {example}: must be only one")
    if example is not None:
        text = device_file.find_device(example).read_text(encoding="utf-8", errors="replace")
        click.echo(escaped(text), nl=False)
    elif device is not None:
        _explain(device, ssv, as_json)
    elif ssv is not None:
        raise click.UsageError(f"--ssv {ssv}: must be with a device file or an example")
    else:
        names = device_file.example_devices()
        titles = {name: device_file.read_device_file(name).title for name in names}
        table = Table(texts("device", "what it is"), list(titles.items()))
        hint = "`slider-resonator device --example NAME > mine.toml` starts a file of your own"
        document = {"devices": [{"name": n, "title": title} for n, title in titles.items()]}
        print_result(document, table, [hint], as_json=as_json)


def _explain(name_or_file: str, ssv: Path | None, as_json: bool) -> None:
    read = device_file.read_device_file(name_or_file)
    device = Device.from_mapping(read.values)
    if ssv is not None:
        distinct({"--ssv": ssv}, {"the device": read.path})
        write_text(ssv, device_file.to_ssv(device, read.title))
    rows = {
        name: {
            "value": value,
            "unit": VARIABLES[name].unit,
            "shown": VARIABLES[name].shown(value),
            "given": name in read.values,
        }
        for name, value in vars(device).items()
    }
    columns = [*texts("parameter"), *numbers("value", "SI"), *texts("from", "meaning")]
    cells = [
        (
            name,
            row["shown"],
            f"{row['value']:.8g}" + ("" if row["unit"] == "1" else f" {row['unit']}"),
            "file" if row["given"] else "table 1",
            PARAMETER_MEANINGS[name],
        )
        for name, row in rows.items()
    ]
    notes = [f"note: {one}" for one in (*read.slips, *device_file.without_drive(read.values))]
    notes += [] if ssv is None else [f"written {one_line(str(ssv))}"]
    document = {"device": rows, "possible_slips": read.slips}
    shown = ([read.title], Table(columns, cells), [*_derived(device), *notes])
    print_result(document, *shown, as_json=as_json)


def _derived(device: Device) -> list[str]:
    faces = number_of(device.friction_faces, "face")
    friction = VARIABLES["load"].shown(device.mean_friction)
    lines = [f"friction of {faces} at the mean normal load: {friction}"]
    if device.resonator_mass > 0.0:
        free = device.resonator_frequency * (device.total_mass / device.slider_mass) ** 0.5
        resonance = VARIABLES["resonator_frequency"].shown(free)
        lines.append(f"resonance of the slider without friction: {resonance}")
    if device.normal_amplitude > device.normal_preload:
        lines.append("the normal load's amplitude is above its mean: the contact lifts off")
    return lines
