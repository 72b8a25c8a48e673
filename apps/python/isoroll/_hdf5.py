"""Who may call the HDF5 library."""

from __future__ import annotations

import contextlib
import threading
from typing import Any, ContextManager

_lock = threading.Lock()


def calls(path: bytes) -> ContextManager[Any]:
    """Held while the library reads or writes this file: not every HDF5 can be called by two threads."""
    return _lock if path.endswith((b".h5", b".hdf5")) else contextlib.nullcontext()
