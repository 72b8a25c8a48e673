"""Exceptions: one for each status of the library (lib/base/status.h), with the library's words."""

from __future__ import annotations

import re
import sys
import warnings
from typing import Optional


def in_python(words: str) -> str:
    """Words of the library as they fit here: an option of the command is a keyword, and keywords have no lines."""
    words = re.sub(r"^<keywords>:\d+:\d+: ", "", words)
    return re.sub(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)", lambda option: option[1].replace("-", "_"), words)


class IsorollError(Exception):
    """A call of the library failed. str() gives its words.

    status   the name of the status in C, such as "ISO_BAD_INPUT"
    about    the quantity that the failure is about, such as "normal"; "" if there is none
    partial  what was computed before the failure (a Table), or None
    """

    status = "ISO_OK"
    about = ""
    partial: Optional[object] = None


class BadArgument(IsorollError, ValueError):
    """A call with numbers or names that it does not take."""

    status = "ISO_BAD_ARGUMENT"


class BadType(BadArgument, TypeError):
    """An object of a class that a call does not take: None in place of a table, a text in place of a number."""


class BadInput(IsorollError, ValueError):
    """A scene or a file says something that cannot be."""

    status = "ISO_BAD_INPUT"


class NotMapped(IsorollError, ValueError):
    """Outside of the isomorphism: the other model has no such orbit."""

    status = "ISO_NOT_MAPPED"


class NumericalFailure(IsorollError, ArithmeticError):
    """The integration stopped, or a result is not finite."""

    status = "ISO_NUMERICAL"


class Stopped(IsorollError):
    """Stopped on request."""

    status = "ISO_STOPPED"


class FileTrouble(IsorollError, OSError):
    """A file cannot be opened, read, written or renamed."""

    status = "ISO_FILE_TROUBLE"


class NoMemory(IsorollError, MemoryError):
    """There is no memory."""

    status = "ISO_NO_MEMORY"


class ClosedPipe(FileTrouble):
    """The reader of what is written has gone."""

    status = "ISO_CLOSED_PIPE"


class IsorollWarning(UserWarning):
    """The call went well, but there is something to know: contact is lost, a column is passed over, ..."""


class LibraryError(ImportError):
    """The shared library libisoroll is not found, or is of another version than this package."""


#: in the order of iso_status; 0 is ISO_OK
STATUS = (IsorollError, BadArgument, BadInput, NotMapped, NumericalFailure, Stopped, FileTrouble, NoMemory,
          ClosedPipe)


def make(status: int, message: str, about: str) -> IsorollError:
    """The exception of a status."""
    error = STATUS[status if 0 < status < len(STATUS) else 0](in_python(message))
    error.about = about
    return error


def warn(words: str) -> None:
    """Warns where the caller's own code stands: at the first frame outside of this package."""
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and str(frame.f_globals.get("__name__", "")).partition(".")[0] == __package__:
        level, frame = level + 1, frame.f_back
    warnings.warn(in_python(words), IsorollWarning, stacklevel=level)
