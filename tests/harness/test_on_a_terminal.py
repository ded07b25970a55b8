"""Commands on a pseudo terminal: lines that fit, progress, and an interruption by Ctrl-C."""

import os
import re
import signal
import sys
import time
from pathlib import Path

import pytest

pty = pytest.importorskip("pty", reason="pseudo terminals are of Unix")

WIDTH = 60
SECONDS = 120.0
"""After which a command counts as hanging."""
CONTROL = re.compile(r"\x1b\[[0-9;?]*[a-zA-Z]")
ERASED = "\x1b[2K"
"""Erases a line, as each frame of a progress bar does."""
LONG = "a_folder_with_a_long_name_that_is_not_there"


def on_terminal(*arguments: object, interrupt_at: str = "") -> tuple[int, str]:
    """Run a command; return its exit code and what it showed, less control sequences.

    Ctrl-C is pressed as soon as it shows `interrupt_at`.
    """
    child, screen = pty.fork()
    if child == 0:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        # Without COLUMNS, which the line editor of the interpreter may have set behind its back.
        environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
        command = [sys.executable, "-c", SIZED, *map(str, arguments)]
        os.execve(sys.executable, command, environment | {"TERM": "xterm"})
    shown, pressed, began = "", False, time.monotonic()
    while time.monotonic() - began < SECONDS:
        try:
            read = os.read(screen, 65536)
        except OSError:  # the other end is closed
            break
        if not read:
            break
        shown += CONTROL.sub("", read.decode(errors="replace").replace(ERASED, "\r"))
        if interrupt_at and not pressed and interrupt_at in shown:
            os.write(screen, b"\x03")
            pressed = True
    else:
        os.kill(child, signal.SIGKILL)
    _, status = os.waitpid(child, 0)
    os.close(screen)
    return os.waitstatus_to_exitcode(status), shown


SIZED = f"""
import fcntl, struct, sys, termios
fcntl.ioctl(1, termios.TIOCSWINSZ, struct.pack("HHHH", 50, {WIDTH}, 0, 0))
from studies.cli import main
sys.argv[0] = "slider-resonator"
main()
"""


def lines(shown: str) -> list[str]:
    """The lines that stay, each as it is after the last return of the carriage."""
    return [line.rstrip("\r").rsplit("\r", 1)[-1].rstrip() for line in shown.split("\n")]


def test_an_error_is_wrapped_between_words() -> None:
    code, shown = on_terminal("scenes", "--check", f"{LONG}/scene.toml")
    assert code == 2, shown
    assert f"{LONG}/scene.toml" in shown, "the name is whole"
    assert all(len(line) <= WIDTH for line in lines(shown)), shown


@pytest.mark.slow
def test_an_interrupted_stress_says_what_is_kept(native_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "stress"
    arguments = ("stress", native_fmu, "--random", 1000, "--out", out)
    code, shown = on_terminal(*arguments, interrupt_at="4 of 1000: ")
    assert code == 130, shown
    assert "interrupted" in lines(shown)
    words = " ".join(shown.split("interrupted", 1)[1].split())
    assert words.startswith(f"the verdicts of finished cases are kept in {out}"), shown
    long = [line for line in lines(shown.split("interrupted", 1)[1]) if len(line) > WIDTH]
    assert all(str(out) in line for line in long), "only a path may be longer than a line"
    assert (out / "stress.json").is_file()


def test_an_interrupted_build_ends_with_130(tmp_path: Path) -> None:
    code, shown = on_terminal("build", "--out", tmp_path, interrupt_at="compiling")
    assert code == 130, shown
    assert "Traceback" not in shown
    assert "interrupted" in shown


@pytest.mark.slow
def test_a_choice_counts_what_it_does(native_fmu: Path) -> None:
    code, shown = on_terminal("choose", "feed_forward", "--fmu", native_fmu)
    assert code == 0, shown
    assert re.search(r"\d of 4: \S", shown), shown
