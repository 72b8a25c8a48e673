"""Sweeps: many scenes that differ in some numbers, and what is measured at each of them."""

from __future__ import annotations

import os
from ctypes import byref
from typing import Any, Mapping, Optional, Tuple, Union

import numpy as np

from . import _errors
from ._kinds import Sweep
from ._library import check, context, encoded, interruptible, lib, whole
from ._scene import Scene
from ._study import Progress, ProgressLike, lines_of
from ._table import Table, from_record, new_record
from ._yaml import dump

SweepLike = Union[str, "os.PathLike[str]", Mapping[str, Any]]


def _text(source: Mapping[str, Any]) -> bytes:
    return dump({key: value.sections if isinstance(value, Scene) else value for key, value in source.items()})


def _named(source: SweepLike) -> Tuple[str, Optional[bytes]]:
    """What messages call a sweep, and its text; None: it stands in the file of this name."""
    if isinstance(source, Mapping):
        return "<dict>", _text(source)
    if isinstance(source, str) and "\n" in source:
        return "<text>", source.encode("utf-8", "surrogateescape")
    if isinstance(source, (str, os.PathLike)):
        return os.fspath(source), None
    raise _errors.BadType(f"a sweep is a path, a text or a dict, not {type(source).__name__}")


def explained(source: Any) -> Optional[Table]:
    """What `isoroll explain` says of a sweep; None: this is no sweep."""
    if not isinstance(source, (str, os.PathLike, Mapping)):
        return None
    (name, text), new, ctx = _named(source), new_record(), context()
    with interruptible():
        status = lib.iso_sweep_text(ctx, encoded(name), text, len(text or b""), byref(new))
    check(status, ctx)
    return from_record(new) if new.value else None


def sweep(source: SweepLike, *, output: Union[None, str, "os.PathLike[str]"] = None, resume: bool = False,
          shard: Optional[str] = None, threads: int = 0, progress: ProgressLike = None) -> Sweep:
    """Measures many scenes on all processors: `isoroll sweep`.

    source    the path of a sweep file (lib/doc/formats.md, section 7); a str with a newline: its text; a dict of its
              keys, whose "scene" can also be a Scene
    output    the file to which rows go as they come, .csv or .h5; None: they stay in memory
    resume    True: go on with what there is of this file; it is no error if there is nothing
    shard     "i/n": compute part i of n alone; `isoroll sweep --merge` puts the files of parts together
    threads   0: one for each processor
    progress  True: a bar on stderr; a function that is called with the part that is done, 0 to 1

    >>> isoroll.sweep({"scene": scene, "vary": {"k": {"from": 0.5, "to": 3, "count": 26}},
    ...                "measure": {"chaos": {}}, "until": {"turns": 1000}}, progress=True)

    Returns a Sweep: a row for each point, with what varies, what was measured, status and reason; a point that fails
    has a status that is not 0. After Ctrl-C, the exception's `partial` has the points that are done; with an output
    they are in FILE.part (of FILE.h5: FILE.h5.csv.part), and the same call with resume=True goes on.
    """
    name, text = _named(source)
    if not isinstance(resume, (bool, np.bool_)):
        raise _errors.BadType(f"resume is {resume!r:.60}, it must be True or False")
    for key, value in (("output", output), ("shard", shard)):
        if not (value is None or isinstance(value, str) or (key == "output" and isinstance(value, os.PathLike))):
            raise _errors.BadType(f"{key} is {value!r:.60}, it must be a text")
    count = whole("threads", threads, 0, 1024)
    given = {"threads": str(count) if count else None,
             "output": None if output is None else os.fspath(output),
             "resume": "true" if resume else None, "shard": shard}
    options = encoded(lines_of({key: text for key, text in given.items() if text is not None}))
    new, ctx, shown = new_record(), context(), Progress(progress)
    kept: list[Any] = []

    def found() -> Any:
        if not kept:
            kept.append(from_record(new) if new.value else None)
        return kept[0]

    with interruptible(found):
        status = lib.iso_sweep_ask(ctx, encoded(name), text, len(text or b""), options, shown.pointer, None, byref(new))
    try:
        shown.end()
        check(status, ctx)
    except BaseException as error:
        error.partial = found()  # type: ignore[attr-defined]
        raise
    table = found()
    if not isinstance(table, Sweep):
        raise _errors.IsorollError("the library gave no result of a sweep")
    return table
