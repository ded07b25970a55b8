"""The command line of a checkout: the commands that are installed, and those of the studies."""

from slider_resonator.cli import main
from studies import COMMANDS

__all__ = ["main"]

main.add_package("studies.commands", COMMANDS)
