"""What the command `isoroll` does for Python: pages of moving models and pictures, whose scripts are in the command."""

from __future__ import annotations

import html
import os
import shutil
import subprocess
import sys
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from numpy.typing import ArrayLike

from . import _errors
from ._library import doubles, encoded, listed, number
from ._scene import Scene, SceneLike
from ._study import text_of
from ._table import PathLike, Table

_STATUS = {2: _errors.BadArgument, 3: _errors.BadInput, 4: _errors.NumericalFailure, 5: _errors.FileTrouble}


def find() -> str:
    """The path of the command: ISOROLL_COMMAND, or that of this Python, or of the shell."""
    beside = os.path.join(sys.prefix, "bin", "isoroll")
    path = os.environ.get("ISOROLL_COMMAND") or (beside if os.path.exists(beside) else shutil.which("isoroll"))
    if not path:
        raise _errors.FileTrouble("this needs the command `isoroll`, which is not found: install it, or set "
                                  "ISOROLL_COMMAND to its path")
    return path


def run_command(arguments: Sequence[str], folder: Optional[str] = None) -> str:
    """What the command prints. Its failures are exceptions with its words."""
    path = find()
    try:
        done = subprocess.run([path, *arguments], capture_output=True, cwd=folder, check=False)
    except OSError as error:
        raise _errors.FileTrouble(f"the command '{path}' cannot be run: {error}") from None
    said = done.stderr.decode("utf-8", "replace").strip().replace("isoroll: ", "")
    if done.returncode == 1:
        _errors.warn(said)
    elif done.returncode != 0:
        raise _STATUS.get(done.returncode, _errors.IsorollError)(said or f"'{path}' ended with {done.returncode}")
    return done.stdout.decode("utf-8", "replace")


class Page(str):
    """A page of HTML, as a str; a notebook shows it."""

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{html.escape(self)}" width="100%" height="640" frameborder="0"></iframe>'


def _path(path: PathLike) -> str:
    return os.path.abspath(os.fsdecode(encoded(path)))


def _options(given: Mapping[str, Any]) -> List[str]:
    return [f"--{key.replace('_', '-')}={text_of(key, value)}" for key, value in given.items() if value is not None]


def view(source: Union[None, SceneLike, Table] = None, output: Optional[PathLike] = None, *, live: bool = False,
         k: Optional[float] = None, J: Optional[ArrayLike] = None, eps: Optional[float] = None,
         h: Optional[float] = None, scene: Optional[SceneLike] = None,
         columns: Union[None, str, Sequence[str]] = None, row_tolerance: Optional[float] = None) -> Optional[Page]:
    """A page in which ball and point move side by side: `isoroll view`, which must be installed.

    source         a scene, a trajectory or a section; or the path of a file of one of these; None: only if live
    output         the file of the page; None: the page is returned, and a notebook shows it
    live           with the library inside: change k, J, what acts and the start in the page; for a scene, or None
    k, J, eps, h   if the table does not say them
    scene          take k, J and the effects from this scene
    columns        of a file without names: those of its columns from left to right
    row_tolerance  largest error of a row's state (default 1e-5)

    The page is one file that needs no network. Its script, its style and how it is put together are in the command;
    a second copy here could differ. So this function runs the command that ISOROLL_COMMAND names, or that stands
    beside this Python, or that the shell finds.
    """
    asked = {"k": k, "eps": eps, "h": h, "row_tolerance": row_tolerance}
    given: Dict[str, Any] = {key: number(key, value) for key, value in asked.items() if value is not None}
    given["J"] = None if J is None else doubles("J", J)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "page.html") if output is None else _path(output)
        if source is None:
            if not live:
                raise _errors.BadArgument("view needs a scene or a table; without one only live=True makes a page")
            file = "-"
        elif isinstance(source, Table):
            file = os.path.join(folder, "table.csv")
            source.write(file)
        else:
            file = _file_of(source, os.path.join(folder, "scene.yaml"))
        if scene is not None:
            given["scene"] = _file_of(scene, os.path.join(folder, "of.yaml"))
        if columns is not None:
            given["columns"] = listed("columns", columns)
        run_command(["view", *_options(given), "-o", path, *(["--live"] if live else []), "--", file])
        if output is not None:
            return None
        with open(path, encoding="utf-8") as page:
            return Page(page.read())


def picture(table: Table, output: PathLike, over: Sequence[Table], options: Mapping[str, Optional[str]]) -> None:
    """The command's picture of a table, over which others are drawn: see table.picture."""
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.join(folder, f"table{i}.csv") for i in range(1 + len(over))]
        for each, file in zip([table, *over], files):
            each.write(file)
        run_command(["plot", *_options(options), *(f"--over={file}" for file in files[1:]), "-o", _path(output), "--",
                     files[0]])


def _file_of(source: SceneLike, path: str) -> str:
    """The file of a scene; a scene that has none is written to this one. Other files are left to the command."""
    if isinstance(source, (str, os.PathLike)) and "\n" not in os.fspath(source):
        return os.path.abspath(os.fspath(source))
    with open(path, "w", encoding="utf-8") as file:
        file.write((source if isinstance(source, Scene) else Scene(source)).text)
    return path
