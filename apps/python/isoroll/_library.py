"""The shared library: where it is, which functions of it are used, and how a call is made.

Only functions with plain arguments are used (lib/api/interface.h); of structs only iso_sink is known.
"""

from __future__ import annotations

import ctypes
import numbers
import os
import re
import signal
import sys
import threading
from ctypes import POINTER, c_bool, c_char_p, c_double, c_int, c_size_t, c_void_p
from typing import Any, Callable, Iterator, List, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _errors
from ._version import __version__

ABI = 4  # ISO_INTERFACE of lib/api/interface.h
_OBJECT = POINTER(c_void_p)  # where a new object goes

_NAMES = {"darwin": "libisoroll.0.dylib", "win32": "isoroll.dll"}
NAME = _NAMES.get(sys.platform, "libisoroll.so.0")
_HERE = os.path.dirname(os.path.abspath(__file__))
INSIDE = os.path.join(_HERE, NAME)  # a wheel has the library
_OF_PREFIX = os.path.normpath(os.path.join(_HERE, "..", "..", "..", NAME))  # of PREFIX/lib/python3/dist-packages

# --- the functions: name, result, arguments -------------------------------------------------------------------------

_NOTES = (c_char_p, c_size_t)
_TABLE = {
    "iso_version": (c_char_p,),
    "iso_interface": (c_int,),
    "iso_context_create": (c_void_p,),
    "iso_context_free": (None, c_void_p),
    "iso_context_message": (c_char_p, c_void_p),
    "iso_context_about": (c_char_p, c_void_p),
    "iso_slow_monitor_create": (c_int, c_void_p, c_double, c_void_p, c_void_p, _OBJECT),
    "iso_slow_monitor_free": (None, c_void_p),
    "iso_column": (c_bool, c_int, POINTER(c_char_p)),
    "iso_record_create": (c_int, c_void_p, c_size_t, POINTER(c_char_p), _OBJECT),
    "iso_record_free": (None, c_void_p),
    "iso_record_kind": (c_char_p, c_void_p),
    "iso_record_columns": (c_size_t, c_void_p),
    "iso_record_rows": (c_size_t, c_void_p),
    "iso_record_name": (c_char_p, c_void_p, c_size_t),
    "iso_record_set_kind": (None, c_void_p, c_char_p),
    "iso_record_has_words": (c_bool, c_void_p, c_size_t),
    "iso_record_set_words": (None, c_void_p, c_size_t, c_bool),
    "iso_record_intern": (c_int, c_void_p, c_void_p, c_char_p, POINTER(c_double)),
    "iso_record_word": (c_char_p, c_void_p, c_double),
    "iso_record_row": (c_void_p, c_void_p, c_size_t),
    "iso_record_line": (c_bool, c_void_p, c_size_t, POINTER(c_char_p), POINTER(c_char_p)),
    "iso_record_get": (c_char_p, c_void_p, c_char_p),
    "iso_record_set": (c_int, c_void_p, c_void_p, c_char_p, c_char_p),
    "iso_record_add": (c_int, c_void_p, c_void_p, c_size_t, c_void_p),
    "iso_scene_read": (c_int, c_void_p, c_char_p, _OBJECT),
    "iso_scene_parse": (c_int, c_void_p, c_char_p, c_char_p, c_size_t, _OBJECT),
    "iso_scene_copy": (c_int, c_void_p, c_void_p, _OBJECT),
    "iso_scene_free": (None, c_void_p),
    "iso_scene_set": (c_int, c_void_p, c_void_p, c_char_p, c_char_p),
    "iso_scene_replace": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p),
    "iso_scene_numbers": (c_int, c_void_p, c_char_p, POINTER(c_double)),
    "iso_scene_word": (c_char_p, c_void_p, c_char_p),
    "iso_scene_key": (c_bool, c_int, POINTER(c_char_p), POINTER(c_char_p)),
    "iso_scene_text": (c_int, c_void_p, c_void_p, c_char_p, c_size_t, POINTER(c_size_t)),
    "iso_yaml_json": (c_int, c_void_p, c_char_p, c_char_p, c_size_t, c_char_p, c_size_t, POINTER(c_size_t)),
    "iso_scene_columns": (c_int, c_void_p, POINTER(c_int)),
    "iso_solution_create": (c_int, c_void_p, c_void_p, _OBJECT),
    "iso_solution_free": (None, c_void_p),
    "iso_solution_context": (c_void_p, c_void_p),
    "iso_solution_word": (c_char_p, c_void_p, c_char_p),
    "iso_solution_number": (c_double, c_void_p, c_char_p),
    "iso_solution_at": (c_int, c_void_p, c_void_p, c_size_t, c_void_p) + _NOTES,
    "iso_batch": (c_int, c_void_p, POINTER(c_void_p), c_size_t, c_size_t, c_void_p, c_void_p, c_void_p,
                          c_void_p, c_size_t, c_int, c_char_p, c_void_p, c_void_p),
    "iso_study_ask": (c_int, c_void_p, c_char_p, c_void_p, c_void_p, c_char_p, c_void_p, c_void_p),
    "iso_study_text": (c_int, c_void_p, c_void_p, c_int, c_char_p, c_size_t, POINTER(c_size_t)),
    "iso_study_name": (c_char_p, c_int),
    "iso_study_doc": (c_char_p, c_char_p),
    "iso_study_of": (c_int, c_char_p),
    "iso_study_option": (c_bool, c_char_p, c_int, POINTER(c_char_p)),
    "iso_study_option_word": (c_char_p, c_char_p, c_int, c_int),
    "iso_kind_name": (c_char_p, c_int),
    "iso_kind_column": (c_bool, c_char_p, c_int, c_char_p, POINTER(c_char_p)),
    "iso_list": (c_int, c_void_p, c_char_p, c_char_p, c_size_t, POINTER(c_size_t)),
    "iso_sweep_ask": (c_int, c_void_p, c_char_p, c_char_p, c_size_t, c_char_p, c_void_p, c_void_p, _OBJECT),
    "iso_sweep_text": (c_int, c_void_p, c_char_p, c_char_p, c_size_t, _OBJECT),
    "iso_record_read": (c_int, c_void_p, c_char_p, c_char_p, _OBJECT) + _NOTES,
    "iso_record_write": (c_int, c_void_p, c_char_p, c_void_p, c_int, c_char_p),
    "iso_picture_of": (c_int, c_void_p, c_void_p, c_char_p, POINTER(c_char_p), c_void_p),
}

# --- finding the library --------------------------------------------------------------------------------------------


def _candidates() -> Iterator[str]:
    """Names and paths to try. The loader knows the usual folders, LD_LIBRARY_PATH and ld.so.conf."""
    yield from (path for path in (INSIDE, _OF_PREFIX) if os.path.exists(path))
    yield NAME
    for prefix in (sys.prefix, "/usr/local", os.path.expanduser("~/.local")):
        yield os.path.join(prefix, "lib", NAME)


def _load() -> ctypes.CDLL:
    wanted = os.environ.get("ISOROLL_LIBRARY")
    reasons = []
    for name in [wanted] if wanted else _candidates():
        if os.path.isabs(name) and not wanted and not os.path.exists(name):
            reasons.append(f"{name}: there is no such file")
            continue
        try:
            return ctypes.CDLL(name)
        except OSError as error:
            reasons.append(str(error))
    how = ("ISOROLL_LIBRARY names this file." if wanted else
           f"Install isoroll (cmake --install, then ldconfig), or set ISOROLL_LIBRARY to the path of {NAME}.")
    raise _errors.LibraryError(f"the library of isoroll cannot be loaded. {how} Tried: " + "; ".join(reasons))


def _declare(library: ctypes.CDLL) -> ctypes.CDLL:
    """Types of all functions, after a look at the version."""
    name = library._name
    try:
        library.iso_version.restype = c_char_p
        version = library.iso_version().decode()
    except AttributeError:
        raise _errors.LibraryError(f"{name} is not the library of isoroll: it has no function iso_version") from None
    if version.split(".")[:2] != __version__.split(".")[:2]:
        raise _errors.LibraryError(f"{name} is isoroll {version}, and this Python package is {__version__}: "
                                   "install both from one source")
    for function, types in _TABLE.items():
        try:
            entry = getattr(library, function)
        except AttributeError:
            raise _errors.LibraryError(f"{name} (isoroll {version}) has no function {function}, which this Python "
                                       f"package {__version__} needs: install both from one source") from None
        entry.restype, entry.argtypes = types[0], types[1:]
    if library.iso_interface() != ABI:
        raise _errors.LibraryError(f"{name} has interface {library.iso_interface()} for other languages, and this "
                                   f"Python package knows {ABI}: install both from one source")
    return library


lib = _declare(_load())

# --- Ctrl-C ---------------------------------------------------------------------------------------------------------
# While the library computes, Python cannot run its signal handlers. So the library calls _go_on ten times a second.
# In this call Python can run the handler, which is _note during a call: it keeps the signal. The library then stops.

_signals: List[Tuple[int, Any]] = []
_raised: List[BaseException] = []  # by the handler of another signal, such as SIGALRM, in _goes_on: it ends the call
try:  # the same functions without the enums of `signal`, which take longer than a short call
    from _signal import getsignal as _getsignal, signal as _setsignal  # type: ignore[import]
except ImportError:
    from signal import getsignal as _getsignal, signal as _setsignal
_SIGINT = int(signal.SIGINT)
_MAIN = threading.main_thread().ident


def _goes_on(_unused: object) -> bool:
    try:
        return not (_signals or _raised) or threading.get_ident() != _MAIN
    except BaseException as error:
        _raised.append(error)
        return False


_go_on = ctypes.CFUNCTYPE(c_bool, c_void_p)(_goes_on)
ctypes.pythonapi.Py_IncRef(ctypes.py_object(_go_on))  # for ever: a daemon thread may call it while Python ends


def _keep_raised(ignored: Any) -> None:
    """For sys.unraisablehook: a handler may raise before the first line of _goes_on. ctypes would only print it."""
    ours = ignored.object is _goes_on or (ignored.object is None and repr(_goes_on) in (ignored.err_msg or ""))
    if ours and isinstance(ignored.exc_value, BaseException):
        _raised.append(ignored.exc_value)
    else:
        _hook(ignored)


_hook: Any = sys.__unraisablehook__  # the host's


def _note(number: int, frame: Any) -> None:
    _signals.append((number, frame))


class interruptible:
    """Lets Ctrl-C end a call of the library. The user's handler then runs; usually it raises KeyboardInterrupt. An
    exception by the handler of another signal ends the call as well.

    found  gives what the call has computed so far, a Table or None: the exception's `partial`
    """

    __slots__ = ("main", "handler", "hook", "found")

    def __init__(self, found: Optional[Callable[[], Any]] = None) -> None:
        self.found = found

    def __enter__(self) -> None:
        self.main = threading.get_ident() == _MAIN
        if self.main:
            global _hook
            self.handler, self.hook = _getsignal(_SIGINT), sys.unraisablehook
            if self.hook is not _keep_raised:
                _hook = self.hook
            _signals.clear()
            _raised.clear()
            sys.unraisablehook = _keep_raised
            if callable(self.handler):
                _setsignal(_SIGINT, _note)

    def __exit__(self, *_unused: Any) -> None:
        if not self.main:
            return
        sys.unraisablehook = self.hook
        if callable(self.handler):
            _setsignal(_SIGINT, self.handler)
        if _signals or _raised:
            self._raise()

    def _raise(self) -> None:
        signals, raised = _signals[-1:], _raised[:1]
        _signals.clear()
        _raised.clear()
        try:
            if raised:
                raise raised[0]
            self.handler(*signals[0])
        except BaseException as stop:
            if self.found is not None:
                stop.partial = self.found()  # type: ignore[attr-defined]
            raise


# --- objects of the library, and contexts ---------------------------------------------------------------------------


class Owned:
    """An object of the library. It is freed with this one, and so it cannot be copied."""

    _free: Any = None
    _pointer: Optional[int] = None

    @property
    def pointer(self) -> int:
        if not self._pointer:
            name = type(self).__name__
            raise _errors.BadArgument(f"this {name} was never made: call isoroll.{name}()")
        return self._pointer

    def _own(self, pointer: Optional[int], free: Any) -> None:
        self._pointer, self._free = pointer, free  # the function is kept: at exit this module may go first

    def __del__(self, _ends: Any = sys.is_finalizing) -> None:
        if self._pointer and not _ends():  # while Python ends, a daemon thread may still be in a call with it
            self._free(self._pointer)

    def __reduce_ex__(self, protocol: Any) -> Any:
        name = type(self).__name__
        article = "an" if name[0] in "AEIOU" else "a"
        raise TypeError(f"{article} {name} of isoroll lives in the library: it cannot be copied or pickled")


class New(c_void_p):
    """Where a call puts a new object. The object is freed, unless it is taken over: an exception may come first."""

    def __init__(self, free: Any) -> None:
        super().__init__()
        self._free = free

    def take(self) -> Optional[int]:
        pointer, self.value = self.value, None
        return pointer

    def __del__(self, _ends: Any = sys.is_finalizing) -> None:
        if self.value and not _ends():
            self._free(self.value)


class Monitor(Owned):
    """Lets Ctrl-C stop what is done with a context. Its holder frees the context first."""

    def __init__(self, pointer: int) -> None:
        new = c_void_p()
        check(lib.iso_slow_monitor_create(pointer, 0.1, ctypes.cast(_go_on, c_void_p), None, ctypes.byref(new)),
              pointer)
        self._own(new.value, lib.iso_slow_monitor_free)


class _Context(Owned):
    """A context; it goes when its thread ends."""

    def __init__(self) -> None:
        self._own(lib.iso_context_create(), lib.iso_context_free)
        if not self._pointer:
            raise _errors.NoMemory("no memory for a context")
        self._monitor = Monitor(self.pointer)


class Notes:
    """Room for the notes of a call; tell() makes warnings of them."""

    _ROOM = 2048

    def __init__(self) -> None:
        self.buffer = _thread.notes
        self.arguments = (self.buffer, self._ROOM)

    def tell(self) -> None:
        if self.buffer[0] == b"\0":
            return
        for line in self.buffer.value.decode("utf-8", "replace").split("\n"):
            _errors.warn(line)


class _OfThread(threading.local):
    def __init__(self) -> None:
        self.context = _Context()
        self.notes = ctypes.create_string_buffer(Notes._ROOM)


def fraction(value: Any) -> Optional[str]:
    """Fraction(1, 2), or the text of a fraction, as a text: "1/2". None: it is neither."""
    if isinstance(value, numbers.Rational) and not isinstance(value, numbers.Integral):
        return f"{value.numerator}/{value.denominator}"
    return value if isinstance(value, str) and re.fullmatch(r"[-+.\deE]+/[-+.\deE]+", value) else None


def _quotient(name: str, value: Any) -> Any:
    """What is a fraction as a double; lists part by part; other things as they are."""
    if isinstance(value, (list, tuple)):
        return [_quotient(name, item) for item in value]
    text = fraction(value)
    if text is None:
        return value
    try:
        top, below = map(float, text.split("/"))
        return top / below
    except (ValueError, ZeroDivisionError):
        raise _errors.BadArgument(f"{name} is {value!r:.60}, it must be a number or a fraction such as 1/2") from None


def number(name: str, value: Any) -> Any:
    """A number as it is: of Python or of NumPy, or a fraction. Others that float() would take are none: bool, "1e3",
    b"1", a time."""
    value = _quotient(name, value)
    if isinstance(value, np.ndarray) and value.ndim == 0 and not np.ma.is_masked(value):
        value = value[()]
    if isinstance(value, (bool, np.bool_, np.timedelta64)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise _errors.BadType(f"{name} is {value!r:.60}, it must be a number")
    return value


def real(name: str, value: Any) -> float:
    """A number as a double."""
    try:
        return float(number(name, value))
    except OverflowError:
        raise _errors.BadArgument(f"{name} is out of the range of doubles") from None


def whole(name: str, value: Any, least: int, most: int = 2**63 - 1) -> int:
    """A whole number that fits the C type. ctypes would cut a larger one without a message."""
    value = number(name, value)
    if not least <= value <= most or value != int(value):
        raise _errors.BadArgument(f"{name} is {value}, it must be a whole number from {least} to {most}")
    return int(value)


def doubles(what: str, values: Any) -> NDArray[np.float64]:
    """Numbers as float64. Those that have no such form are refused: bool, complex ones, words, bytes, masked ones."""
    if type(values) is np.ndarray and values.dtype == np.float64:
        return values
    try:
        array = np.asarray(values)
    except (ValueError, TypeError) as error:
        raise _errors.BadArgument(f"{what}: {error}") from None
    if isinstance(values, (bytes, bytearray, memoryview)):
        raise _errors.BadType(f"{what} must be real numbers, not {type(values).__name__}")
    if np.ma.is_masked(values):
        raise _errors.BadArgument(f"{what} has masked numbers: fill them first")
    if array.dtype.kind in "OU":  # there may be fractions
        array = np.asarray(_quotient(what, array.tolist()))
    if array.dtype != np.float64 and array.dtype.kind not in "iuf":
        raise _errors.BadType(f"{what} must be real numbers, not {array.dtype}")
    return np.asarray(array, dtype=np.float64)


def items(what: str, values: Any, kind: Any = object) -> List[Any]:
    """The parts of something that has parts, all of a kind."""
    try:
        found = list(values)
    except TypeError:
        found = None
    if found is None or not all(isinstance(value, kind) for value in found):
        of_texts = " of texts" if kind is str else ""
        raise _errors.BadType(f"{what} is {values!r:.60}, it must be a list{of_texts}")
    return found


def listed(what: str, names: Any) -> str:
    """Names as C takes them: a text as it is, others with commas between."""
    return names if isinstance(names, str) else ",".join(items(what, names, str))


def encoded(text: Any) -> bytes:
    """A text or a path as bytes. C ends a text at a zero byte, so a zero byte is refused."""
    try:
        code = os.fsencode(text)
    except TypeError:
        raise _errors.BadType(f"a text or a path is needed, not {type(text).__name__}") from None
    except UnicodeError as error:
        raise _errors.BadArgument(f"{text!r:.60}: {error}") from None
    if b"\0" in code:
        raise _errors.BadArgument(f"{text!r} has a zero byte in it")
    return code


def check(status: int, context: int) -> None:
    """Raises what the status means, in the words of the context."""
    if status != 0:
        raise _errors.make(status, lib.iso_context_message(context).decode("utf-8", "replace"),
                           lib.iso_context_about(context).decode("utf-8", "replace"))


_thread = _OfThread()


def context() -> int:
    """The context of this thread."""
    return _thread.context.pointer
