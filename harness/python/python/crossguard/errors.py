"""What can be wrong with what the package is given."""


class BrokenInequality(ValueError):
    """The values of a `Config` break an inequality between them."""

    def __init__(self, text: str, inequality: str, formula: str) -> None:
        super().__init__(text, inequality, formula)

    def __str__(self) -> str:
        return str(self.args[0])

    @property
    def inequality(self) -> str:
        """Its name, `lease-within-safety` for example."""
        return str(self.args[1])

    @property
    def formula(self) -> str:
        """What would hold."""
        return str(self.args[2])


class DecodeError(ValueError):
    """Octets are not a message or packet."""

    def __init__(self, text: str, cause: str) -> None:
        super().__init__(text, cause)

    def __str__(self) -> str:
        return str(self.args[0])

    @property
    def cause(self) -> str:
        """The name that counters have for it, `truncated` for example."""
        return str(self.args[1])


class EncodeError(ValueError):
    """A dictionary is no message or packet, or has no encoding."""


class UnreadableLog(ValueError):
    """A log is empty, or has a line that is no record."""


class BootError(Exception):
    """There is no boot counter to be had; the robot does not start."""
