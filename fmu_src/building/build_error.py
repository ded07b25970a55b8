"""The error of a failed build."""


class BuildError(Exception):
    """The FMU cannot be built; the text gives the reason."""
