"""Made by `python3 -m isoroll._stub` from the library's tables; tests/python compares it."""

from typing import Any, Callable, Dict, Literal, Mapping, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike

from ._kinds import Branch, Chaos, Chart, Comparison, Cost, Periodic, Result, Section, Splitting
from ._scene import SceneLike
from ._study import ProgressLike
from ._table import PathLike, Table

TableLike = Union[Table, PathLike]
INSTRUMENTS: Dict[str, Callable[..., Any]]

def python_name(option: str) -> str: ...

def section(
    scene: SceneLike,
    *,
    crossings: Optional[int] = None,
    axis: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    event: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    starts: Optional[int] = None,
    seed: Optional[int] = None,
    at: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    cloud: Optional[int] = None,
    model: Optional[Literal["ball", "point", "both"]] = None,
    as_: Optional[Literal["ball", "point", "both"]] = None,
    tol: Optional[float] = None,
    threads: Optional[int] = None,
    progress: ProgressLike = None,
) -> Union[Section, Table]:
    """Compute the Poincare section of both models: `isoroll section`.

    scene            a path, YAML text, a dict or a Scene
    crossings        crossings of each orbit (default 500)
    axis             which section n_A = 0, n_A increasing; auto (default): a global one: 1, 2, 3 or
                     "auto"
    event            in place of axis: crossings where this column passes this value upwards: ("omega1",
                     0.1)
    starts           M more orbits of the same energy, spread evenly over the section
    seed             another number spreads starts in another way (default 0)
    at               further orbits, which start at these (l, x): an array of shape (starts, 2)
    cloud            write no crossings: test with N states, 512 or more, whether the flow keeps the
                     invariant measure
    model            which model is integrated (default: both, where the ball has a twin)
    as_              add the states of a model to each row: ball, point, both
    tol              largest relative error of one step, in [1e-15, 0.1]
    threads          threads that work (default: one for each processor)
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Section: a row for each crossing. With cloud a Table: a row for each test of the measure.
    After a failure or Ctrl-C, the exception's `partial` is what was found before."""

def chaos(
    scene: SceneLike,
    *,
    turns: Optional[int] = None,
    exponent_turns: Optional[int] = None,
    starts: Optional[int] = None,
    seed: Optional[int] = None,
    model: Optional[Literal["ball", "point", "both"]] = None,
    axis: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    tol: Optional[float] = None,
    threads: Optional[int] = None,
    at: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    progress: ProgressLike = None,
) -> Chaos:
    """Tell whether an orbit is chaotic, and which part of the section is chaotic: `isoroll chaos`.

    scene            a path, YAML text, a dict or a Scene
    turns            follow each orbit for at most N turns (default 3000); it ends earlier once there is
                     a verdict
    exponent_turns   go on with a chaotic orbit until it has N turns, for its exponent; default 0: it
                     ends with the verdict
    starts           M more orbits of the same energy, spread evenly over the section: tells which part
                     of it is chaotic
    seed             another number spreads starts in another way (default 0)
    model            which model is integrated (default: both, where the ball has a twin). Of the starts
                     the ball follows every 16th, as a check; with both, all
    axis             a turn is a return to n_A = 0, n_A increasing, which must be global; auto
                     (default): one that is: 1, 2, 3 or "auto"
    tol              largest relative error of one step, in [1e-15, 0.1]
    threads          threads that work (default: one for each processor)
    at               further orbits, which start at these (l, x): an array of shape (starts, 2)
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Chaos: a row for each orbit, the scene's own first; its `share`, its `indicators`. After a
    failure or Ctrl-C, the exception's `partial` is what was found before."""

def frequencies(
    scene: SceneLike,
    *,
    turns: Optional[float] = None,
    t_end: Optional[float] = None,
    samples: Optional[int] = None,
    progress: ProgressLike = None,
) -> Result:
    """Compute frequencies, actions, rotation number and near resonances: `isoroll frequencies`.

    scene            a path, YAML text, a dict or a Scene
    turns            length of the orbit in turns, 20 or more (default 1000, more if needed)
    t_end            length of the orbit in time t, in place of turns
    samples          number of samples of the orbit, at most 4194304, rounded up to a power of 2
                     (default 32 each turn)
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Result: numbers by the names of the command's --json, result.rotation_number, ... After a
    failure or Ctrl-C, the exception's `partial` is what was found before."""

def periodic(
    scene: SceneLike,
    *,
    period: Optional[int] = None,
    all: bool = False,
    grid: Optional[int] = None,
    polish: bool = False,
    follow: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    orbit: Optional[int] = None,
    branches: bool = False,
    chart: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    k: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    level: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    steps: Optional[int] = None,
    threads: Optional[int] = None,
    progress: ProgressLike = None,
) -> Union[Periodic, Branch, Chart]:
    """Find periodic orbits, and whether they are stable: `isoroll periodic`.

    scene            a path, YAML text, a dict or a Scene
    period           orbits of at most P returns to the section (default 6)
    all              orbits without a symmetry as well, by Newton's method from a grid
    grid             points of that grid (default 2000)
    polish           compute with 128 bits and print 30 digits
    follow           follow orbits while k, a moment, the ratio (J2 - J1)/(J3 - J1) or the level goes
                     from A to B: {"k": (0.4, 0.6)}
    orbit            follow orbit N of the list alone
    branches         follow what branches off, too
    chart            in place of all that: where rotations are stable, in the plane of k and this moment
                     or the level, from A to B: "J2", {"J2": (1, 4)} or {"level": (-1, 1)}
    k                k of chart (default -3:3): (-3, 3)
    level            the level of chart, everywhere (default: the scene's): a number
    steps            steps of chart in both directions (default 120)
    threads          threads that work (default: one for each processor)
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Periodic: a row for each orbit; with follow a Branch, with chart a Chart. After a failure
    or Ctrl-C, the exception's `partial` is what was found before."""

def splitting(
    scene: SceneLike,
    *,
    k: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    level: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    digits: Optional[Literal["double", "quad", "auto"]] = None,
    threads: Optional[int] = None,
    progress: ProgressLike = None,
) -> Splitting:
    """Measure how far the separatrix splits: why only k = 1 and k = -1: `isoroll splitting`.

    scene            a path, YAML text, a dict or a Scene
    k                values of k in place of the scene's, with commas between: ranges A:B:STEP, numbers,
                     fractions such as 1/3: numbers, or a text such as "0.5:3:0.25,1/3"
    level            levels in place of the scene's, at one k: a list like that of k: likewise
    digits           double: 64 bits of mantissa (19 digits); quad: 128 bits (32 digits); auto: 128 bits
                     where 64 give less than 3 digits of m (default)
    threads          threads that work (default: one for each processor)
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Splitting: a row for each k or level. After a failure or Ctrl-C, the exception's `partial`
    is what was found before."""

def prove(
    scene: SceneLike,
    *,
    k: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    digits: Optional[int] = None,
    half_returns: Optional[int] = None,
    pieces: Optional[int] = None,
    progress: ProgressLike = None,
) -> Table:
    """Enclose the splitting of the separatrix: a proof that there is no further integral: `isoroll prove`.

    scene            a path, YAML text, a dict or a Scene
    k                another k than the scene's, such as 1/3, or an interval: all k from A to B; it is
                     halved where it must be: a number, or a text such as "1/3" or "0.5:0.50000000001"
    digits           enclose m to 1e-D (default: 18, 36, 72, until 0 is excluded, without those too few
                     for m, or more where m is tiny; for an interval as its length asks for)
    half_returns     give up on a k, or on a piece of an interval, after N half returns in all attempts
                     (default 20000)
    pieces           try at most N pieces of an interval of k (default 20000)
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Table: a row for k, or for each piece of an interval of k; m is between m_low and m_high.
    For one k its lines have all digits, as the command's --json does. After a failure or Ctrl-C, the
    exception's `partial` is what was found before."""

def integrals(
    scene: SceneLike,
    *,
    degree: Optional[int] = None,
    coefficients: Optional[int] = None,
    orbits: Optional[int] = None,
    turns: Optional[float] = None,
    seed: Optional[int] = None,
    within: Optional[float] = None,
    tol: Optional[float] = None,
    threads: Optional[int] = None,
    progress: ProgressLike = None,
) -> Result:
    """Search for additional first integrals: `isoroll integrals`.

    scene            a path, YAML text, a dict or a Scene
    degree           largest degree in M, to 8 (default 2)
    coefficients     largest degree in gamma of the coefficients, to 8 (default D, at least 2)
    orbits           orbits that are sampled (default 64, more for high degrees)
    turns            turns of each orbit, about, 1 to 1e5 (default 50)
    seed             other starts and times (default 0)
    within           a function that varies by more than X is no integral (default 1e-10)
    tol              largest relative error of one step (default 1e-14)
    threads          threads that work (default: one for each processor)
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Result: what is found, by the names of the command's --json. After a failure or Ctrl-C,
    the exception's `partial` is what was found before."""

def cost(
    scene: SceneLike,
    *,
    backend: Optional[Literal["ball", "point", "exact", "auto"]] = None,
    method: Optional[str] = None,
    tol: Optional[float] = None,
    t_end: Optional[float] = None,
    quick: bool = False,
    want: Optional[float] = None,
    horizons: Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]] = None,
    progress: ProgressLike = None,
) -> Cost:
    """Measure error against time for every backend, method and tolerance: `isoroll cost`.

    scene            a path, YAML text, a dict or a Scene
    backend          what computes the orbit: ball, point, exact, auto
    method           the integrator, or auto
    tol              largest relative error of one step, in [1e-15, 0.1]
    t_end            last time, in place of the scene's
    quick            measure three tolerances only: a few seconds
    want             the lines `choice...` name the cheapest choice with an error of at most this
    horizons         growth over N orbits (default 6), each twice as long as the one before: a whole
                     number
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Cost: a row for each backend, method and tolerance. After a failure or Ctrl-C, the
    exception's `partial` is what was found before."""

def compare(
    scene: SceneLike,
    *,
    method: Optional[str] = None,
    tol: Optional[float] = None,
    t_end: Optional[float] = None,
    step: Optional[float] = None,
    progress: ProgressLike = None,
) -> Comparison:
    """Compute an orbit by every backend and show the differences: `isoroll compare`.

    scene            a path, YAML text, a dict or a Scene
    method           the integrator, or auto
    tol              largest relative error of one step, in [1e-15, 0.1]
    t_end            last time, in place of the scene's
    step             time between rows, in place of the scene's
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Comparison: differences of ball and point over the time; the orbits themselves in its
    `ball`, `point`, `exact`. After a failure or Ctrl-C, the exception's `partial` is what was found
    before."""

def check(
    table: TableLike,
    *,
    scene: Optional[SceneLike] = None,
    columns: Union[None, str, Sequence[str]] = None,
    tol: Optional[float] = None,
    k: Optional[float] = None,
    J: Optional[ArrayLike] = None,
    eps: Optional[float] = None,
    h: Optional[float] = None,
    row_tolerance: Optional[float] = None,
    max: Optional[float] = None,
    progress: ProgressLike = None,
) -> Table:
    """Test whether a trajectory solves its model: `isoroll check`.

    table            a table, or the path of its file
    scene            take k, J and the effects from this scene
    columns          of a file without names: those of its columns from left to right, "-" for one
                     passed over
    tol              tolerance of the flow from row to row (default 1e-13)
    k                geometry number k, if the file does not say it
    J                moments about the contact point, if the file does not say them: three numbers
    eps              coupling of the point's potential, if the file does not say it
    h                energy of the ball, in place of eps
    row_tolerance    largest error of a row's state (default 1e-5); more for rows of few digits
    max              marks residuals that are larger, in the column above_the_bound
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Table: a row for each residual. After a failure or Ctrl-C, the exception's `partial` is
    what was found before."""

def explain(
    scene: SceneLike,
    *,
    backend: Optional[Literal["ball", "point", "exact", "auto"]] = None,
    method: Optional[str] = None,
    tol: Optional[float] = None,
    as_: Optional[Literal["ball", "point", "both"]] = None,
    t_end: Optional[float] = None,
    step: Optional[float] = None,
    progress: ProgressLike = None,
) -> Result:
    """Say what would be simulated and why, without doing it: `isoroll explain`.

    scene            a path, YAML text, a dict or a Scene; or a sweep: how long it takes is told,
                     without options
    backend          what computes the orbit: ball, point, exact, auto
    method           the integrator, or auto
    tol              largest relative error of one step, in [1e-15, 0.1]
    as_              which model is written: ball, point, both
    t_end            last time, in place of the scene's
    step             time between rows, in place of the scene's
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Result, whose `text` is what the command prints; so print(result) shows it. After a
    failure or Ctrl-C, the exception's `partial` is what was found before."""

def analogue(
    scene: Optional[SceneLike] = None,
    *,
    neumann: Optional[ArrayLike] = None,
    k: Optional[float] = None,
    J: Optional[ArrayLike] = None,
    eps: Optional[float] = None,
    energy: Optional[float] = None,
    level: bool = False,
    mass: Optional[float] = None,
    radius: Optional[float] = None,
    progress: ProgressLike = None,
) -> Result:
    """Find a ball that realises a problem of a point on a sphere: `isoroll analogue`.

    scene            a path, YAML text, a dict or a Scene
    neumann          C1,C2,C3 of Neumann's problem V = (1/2) sum C_i gamma_i^2: three numbers
    k                k of the problem V = -eps (gamma, J gamma)^(-1/k)
    J                J of this problem: three numbers
    eps              eps of this problem
    energy           energy of the point, M^2/2 + V (default 0)
    level            k = -1: a ball in the potential of a level, even where there is a free one
    mass             mass of the ball (default: chosen)
    radius           radius of the ball (default: chosen)
    progress         True: a bar on stderr; a function that is called with the part that is done

    Returns a Result, whose `text` is the scene of the ball, with a report in lines of #;
    isoroll.Scene(result.text) is this scene. After a failure or Ctrl-C, the exception's `partial` is
    what was found before."""
