"""isoroll: the rubber Chaplygin ball on a sphere, and its twin, a point on a sphere.

    import isoroll
    table = isoroll.run("scene.yaml")                 # table.t (rows,), table.omega (rows, 3), table.n (rows, 3)
    orbit = isoroll.orbit("scene.yaml", as_="both")
    orbit.at([0, 10, 5]).gamma                        # (3, 3): the point at three times
    isoroll.write(isoroll.convert(table, "point"), "point.csv")

Arrays are not copied: each is a view of the library's memory, or the library has filled it. Units are the scene's,
and angles are radians. omega, n, e, trace and N are in the ball's principal axes; contact and centre are in axes of
space (lib/doc/formats.md, section 4). A failure raises an IsorollError with the library's message. All functions can
be called by several threads at the same time; they compute side by side.
"""

from ._errors import (BadArgument, BadInput, ClosedPipe, FileTrouble, IsorollError, IsorollWarning, LibraryError,
                      NoMemory, NotMapped, NumericalFailure, Stopped)
from ._files import convert, read, write
from ._library import lib as _lib
from ._kinds import Branch, Chaos, Chart, Cost, Periodic, Section, Share, Splitting, Sweep, Trajectory
from ._orbit import Batch, Orbit, batch, orbit, run
from ._scene import Scene
from ._instruments import *
from ._study import study
from ._table import Table, trajectory
from ._version import __version__ as __version__

#: the version of the library that runs
library_version: str = _lib.iso_version().decode()

__all__ = ["BadArgument", "BadInput", "Batch", "Chaos", "ClosedPipe", "FileTrouble", "IsorollError", "IsorollWarning",
           "LibraryError", "NoMemory", "NotMapped", "NumericalFailure", "Orbit", "Run", "Scene", "Section", "Share",
           "Stopped", "Table", "batch", "chaos", "convert", "library_version", "orbit", "read", "run", "section",
           "study", "trajectory", "write"]
