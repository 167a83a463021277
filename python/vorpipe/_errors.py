"""What goes wrong, as exceptions."""
from __future__ import annotations

from typing import Optional, Tuple


class Error(Exception):
    """Any error of vorpipe: one line that names what is wrong with what.

    Attributes:
        code: "input" (the arguments are wrong), "device" (no such device here, or it failed), "cancelled" (the
            caller's progress function said stop) or "check" (a promise is broken).
        subject: the argument that the error is about, as in "weights"; None where it is about none.
    """

    code: str
    subject: Optional[str]

    def __init__(self, message: str, code: str = 'input', subject: Optional[str] = None) -> None:
        super().__init__(message)
        self.code = code
        self.subject = subject

    def __reduce__(self) -> Tuple[object, ...]:
        return type(self), (str(self), self.code, self.subject)


class InputError(Error, ValueError):
    """The arguments or a file are wrong."""


class DeviceError(Error, RuntimeError):
    """No such backend or device here, or it failed; or there is not enough memory."""


class Cancelled(Error):
    """The caller's progress function returned False."""


class CheckError(Error, AssertionError):
    """A result breaks what vorpipe promises: a fault of vorpipe's, or of the device's driver."""

    @property
    def broken(self) -> Tuple[str, ...]:
        """A line for each promise."""
        return tuple(str(self).split('\n'))
