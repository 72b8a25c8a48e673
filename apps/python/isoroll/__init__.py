"""isoroll: the rubber Chaplygin ball on a sphere, and its twin, a point on a sphere.

    import isoroll
    scene = isoroll.Scene(k=0.5, J=(1, 2, 5), normal=(0.36, 0.48, 0.8), angular_velocity=(0.9, -0.3, -0.225))
    table = isoroll.run(scene, as_="both")            # table.t (rows,), table.omega (rows, 3), table.n (rows, 3)
    isoroll.section(scene, starts=50).plot()          # both models side by side, with matplotlib
    isoroll.chaos(scene, starts=100).share            # which part of the section is chaotic
    isoroll.convert(table, "point").write("point.csv")

Every instrument of the command `isoroll` is a function of the same name; its options are keywords: --exponent-turns
700 is exponent_turns=700, --as both is as_="both". Files, scenes and tables are those of the command.

    Scene run orbit batch trajectory              what moves, and its rows
    section chaos periodic splitting prove        all orbits of one energy
    frequencies integrals compare check explain   one orbit
    cost sweep analogue                           methods, families, balls for a point's problem
    read convert plot view list_                  files and pictures

Arrays are not copied: each is a view of the library's memory, or the library has filled it. Units are the scene's,
and angles are radians. omega, n, e, trace and N are in the ball's principal axes; contact and centre are in axes of
space (lib/doc/formats.md, section 4). A failure raises an IsorollError with the library's message. All functions can
be called by several threads at the same time; they compute side by side.
"""

from ._command import Page, view
from ._errors import (BadArgument, BadInput, BadType, ClosedPipe, FileTrouble, IsorollError, IsorollWarning,
                      LibraryError, NoMemory, NotMapped, NumericalFailure, Stopped)
from ._files import convert, read, write
from ._instruments import (analogue, chaos, check, compare, cost, explain, frequencies, integrals, periodic, prove,
                           section, splitting)
from ._kinds import (Branch, Chaos, Chart, Comparison, Cost, Periodic, Result, Section, Share, Splitting, Sweep,
                     Trajectory)
from ._library import lib as _lib
from ._lines import Lines
from ._orbit import Batch, Orbit, batch, orbit, run
from ._plot import plot
from ._scene import Scene
from ._study import list_, study
from ._sweep import sweep
from ._table import Table, trajectory
from ._version import __version__ as __version__

#: the version of the library that runs
library_version: str = _lib.iso_version().decode()

__all__ = ["BadArgument", "BadInput", "BadType", "Batch", "Branch", "Chaos", "Chart", "ClosedPipe", "Comparison",
           "Cost",
           "FileTrouble", "IsorollError", "IsorollWarning", "LibraryError", "Lines", "NoMemory", "NotMapped",
           "NumericalFailure", "Orbit", "Page", "Periodic", "Result", "Scene", "Section", "Share", "Splitting",
           "Stopped", "Sweep", "Table", "Trajectory", "analogue", "batch", "chaos", "check", "compare", "convert",
           "cost", "explain", "frequencies", "integrals", "library_version", "list_", "orbit", "periodic", "plot",
           "prove", "read", "run", "section", "splitting", "study", "sweep", "trajectory", "view", "write"]
