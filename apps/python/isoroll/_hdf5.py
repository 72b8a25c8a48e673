"""Which HDF5 library files in .h5 are read and written with, and who may call it."""

from __future__ import annotations

import contextlib
import os
import re
import threading
from typing import Any, ContextManager, Optional

from ._library import INSIDE, lib

_lock: Optional[Any] = None


def _choose() -> Any:
    """The library of a wheel takes the HDF5 of h5py, if h5py is installed. Returns the lock for calls of HDF5."""
    if lib._name != INSIDE:
        return threading.Lock()
    try:
        from h5py._objects import phil  # h5py holds this lock while it calls HDF5
        with open("/proc/self/maps") as maps:
            found = re.search(r"/.*/libhdf5(_serial)?(-[0-9a-f]+)?\.so\b.*", maps.read())
    except Exception:  # no h5py that works: the library then looks for HDF5 itself, and says what it finds
        return threading.Lock()
    if found:
        os.environ.setdefault("ISOROLL_HDF5", found[0])
    return phil


def calls(path: bytes) -> ContextManager[Any]:
    """Held while the library reads or writes this file: not every HDF5 can be called by two threads."""
    global _lock
    if not path.endswith((b".h5", b".hdf5")):
        return contextlib.nullcontext()
    if _lock is None:
        _lock = _choose()
    return _lock
