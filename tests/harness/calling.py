"""Calling the command line as a user does, in this process."""

from click.testing import CliRunner, Result

from studies.cli import main


def call(*arguments: object, **environment: str) -> Result:
    return CliRunner().invoke(main, [str(argument) for argument in arguments], env=environment)


def refused(*arguments: object) -> str:
    """Call what cannot run, require exit code 2 and return what is reported."""
    result = call(*arguments)
    assert result.exit_code == 2, result.output
    return result.stderr
