"""The instruments: a function for each study of the library, with the name and the options of its command.

Signatures and documentation are made from the library's own tables, so they cannot differ from those of the command.
What an editor shows is in _instruments.pyi, which ../stub.py makes for the wheel.
"""

from __future__ import annotations

import inspect
import keyword
import re
import textwrap
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple

import numpy as np

from . import _errors
from ._files import as_table
from ._kinds import Chaos, Comparison, Section
from ._library import lib
from ._study import NEEDS_RECORD, NEEDS_SCENE, STUDIES, Option, ask, docs, options_of
from ._sweep import explained
from ._table import Table, as_record, doubles

_MOST_ROWS = 1e9  # of a section: more would fill the memory

# --- what comes back ------------------------------------------------------------------------------------------------


def _first(table: Table, *_unused: Any) -> Table:
    return table


def _section(table: Table, point: Optional[Table], *_unused: Any) -> Table:
    if isinstance(table, Section):
        table.point = point
    return table


def _chaos(table: Chaos, *traces: Any) -> Chaos:
    table.indicators = {name: trace for name, trace in zip(("ball", "point"), traces) if trace is not None}
    return table


def _compare(table: Comparison, *others: Any) -> Comparison:
    table.ball, table.point, table.exact, table.ball_exact, table.point_exact = others
    return table


#: how the tables of a study become what its function returns, and what that is
_RETURNS: Dict[str, Tuple[Callable[..., Any], str, str]] = {
    "section": (_section, "Union[Section, Table]",
                "a Section: a row for each crossing. With area a Table: a row for each orbit and model."),
    "chaos": (_chaos, "Chaos",
              "a Chaos: a row for each orbit, the scene's own first; its `share`, its `indicators`."),
    "frequencies": (_first, "Result",
                    "a Result: numbers by the names of the command's --json, result.frequency_ratio, ..."),
    "periodic": (_first, "Union[Periodic, Branch, Chart]",
                 "a Periodic: a row for each orbit; with follow a Branch, with chart a Chart."),
    "splitting": (_first, "Splitting", "a Splitting: a row for each k or level."),
    "prove": (_first, "Table", "a Table: a row for k, or for each piece of an interval of k; m is between m_low and "
              "m_high. For one k its lines have all digits, as the command's --json does."),
    "integrals": (_first, "Result", "a Result: what is found, by the names of the command's --json."),
    "cost": (_first, "Cost", "a Cost: a row for each backend, method and tolerance."),
    "compare": (_compare, "Comparison", "a Comparison: differences of ball and point over the time; the orbits "
                "themselves in its `ball`, `point`, `exact`."),
    "check": (_first, "Table", "a Table: a row for each residual."),
    "explain": (_first, "Result", "a Result, whose `text` is what the command prints; so print(result) shows it."),
    "analogue": (_first, "Result", "a Result, whose `text` is the scene of the ball, with a report in lines of #; "
                 "isoroll.Scene(result.text) is this scene."),
}


# --- signatures -----------------------------------------------------------------------------------------------------

_TYPES = {"flag": "bool", "whole": "Optional[int]", "number": "Optional[float]", "numbers": "Optional[ArrayLike]",
          "text": "Union[None, str, float, ArrayLike, Mapping[str, Any], Tuple[str, float]]"}


def python_name(option: str) -> str:
    """exponent-turns is exponent_turns, as is as_."""
    name = option.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


def _type_of(option: Option) -> str:
    if option.type == "word" and 0 < len(option.words) <= 6:
        return "Optional[Literal[" + ", ".join(f'"{word}"' for word in option.words) + "]]"
    return _TYPES.get(option.type, "Optional[str]")


def _subject(study: str) -> List[inspect.Parameter]:
    """What a study is of: a scene, or a table and perhaps a scene."""
    of, parameter = lib.iso_study_of(study.encode()), inspect.Parameter
    first = parameter.POSITIONAL_OR_KEYWORD
    if of & NEEDS_SCENE:
        return [parameter("scene", first, annotation="SceneLike")]
    if of & NEEDS_RECORD:
        return [parameter("table", first, annotation="TableLike"),
                parameter("scene", parameter.KEYWORD_ONLY, default=None, annotation="Optional[SceneLike]"),
                parameter("columns", parameter.KEYWORD_ONLY, default=None,
                          annotation="Union[None, str, Sequence[str]]")]
    return [parameter("scene", first, default=None, annotation="Optional[SceneLike]")]


def _signature(study: str) -> inspect.Signature:
    parameters = _subject(study)
    for option in options_of(study):
        default = False if option.type == "flag" else None
        parameters.append(inspect.Parameter(python_name(option.name), inspect.Parameter.KEYWORD_ONLY, default=default,
                                            annotation=_type_of(option)))
    parameters.append(inspect.Parameter("progress", inspect.Parameter.KEYWORD_ONLY, default=None,
                                        annotation="ProgressLike"))
    return inspect.Signature(parameters, return_annotation=_RETURNS.get(study, (_first, "Table", ""))[1])


#: how Python writes options that are texts for the command; and what Python does in place of what the command does
_FORMS: Dict[Any, str] = {
    "at": "an array of shape (starts, 2)", "axis": '1, 2, 3 or "auto"', "event": '("omega1", 0.1)',
    "follow": '{"k": (0.4, 0.6)}', "chart": '"J2", {"J2": (1, 4)} or {"level": (-1, 1)}', "J": "three numbers",
    "neumann": "three numbers", ("periodic", "k"): "(-3, 3)",
    ("periodic", "level"): "a number", ("splitting", "k"): 'numbers, or a text such as "0.5:3:0.25,1/3"',
    ("splitting", "level"): "likewise", ("prove", "k"): 'a number, or a text such as "1/3" or "0.5:0.50000000001"'}
_WORDS: Dict[Any, str] = {
    ("explain", "scene"): "a path, YAML text, a dict or a Scene; or a sweep: how long it takes is told, without options",
    "at": "further orbits, which start at these (l, x)",
    ("check", "max"): "marks residuals that are larger, in the column above_the_bound",
    ("cost", "want"): "the lines `choice...` name the cheapest choice with an error of at most this"}

_SUBJECTS = {"scene": "a path, YAML text, a dict or a Scene", "table": "a table, or the path of its file",
             "columns": "of a file without names: those of its columns from left to right, \"-\" for one passed over"}
_OF_RECORD = {"scene": "take k, J and the effects from this scene"}


def _doc(study: str, signature: inspect.Signature) -> str:
    """The documentation in the words of the command."""
    def fold(name: str, words: str) -> str:
        return textwrap.fill(words, 100, initial_indent=f"{name:16} " if len(name) < 16 else f"{name}  ",
                             subsequent_indent=" " * 17)

    own = {python_name(option.name): option for option in options_of(study)}
    lines = [docs()[study][:1].upper() + docs()[study][1:] + f": `isoroll {study}`.", ""]
    for name in signature.parameters:
        option = own.get(name)
        if option is not None:
            words = _WORDS.get((study, name)) or _WORDS.get(name) or option.doc
            words = re.sub(r"--([a-z][a-z-]*)", lambda found: python_name(found.group(1)), words)
            form = _FORMS.get((study, name)) or _FORMS.get(name, option.expected)
            lines.append(fold(name, f"{words}: {form}" if option.type in ("text", "numbers") else words))
        elif name == "progress":
            lines.append(fold(name, "True: a bar on stderr; a function that is called with the part that is done"))
        else:
            words = _OF_RECORD.get(name) if "table" in signature.parameters else _WORDS.get((study, name))
            lines.append(fold(name, words or _SUBJECTS[name]))
    returns = _RETURNS.get(study, (_first, "", "a Table."))[2]
    end = f"Returns {returns} After a failure or Ctrl-C, the exception's `partial` is what was found before."
    return "\n".join([*lines, "", textwrap.fill(end, 100)])


# --- functions ------------------------------------------------------------------------------------------------------


def _guard(study: str, given: Mapping[str, Any]) -> None:
    """A slip of the hand would fill the memory."""
    if study != "section":
        return
    at, asked = given.get("at"), [given.get("crossings"), given.get("starts")]
    crossings, starts = (x.item() if isinstance(x, np.number) else x for x in asked)
    crossings, starts = 500 if crossings is None else crossings, 0 if starts is None else starts
    points = 0 if at is None or isinstance(at, str) else len(at)
    numbers = isinstance(crossings, (int, float)) and isinstance(starts, (int, float))
    if numbers and (starts + points + 1) * crossings > _MOST_ROWS:
        raise _errors.BadArgument(f"crossings is {crossings}: with {starts + points + 1} orbits these are more than "
                                  "1e9 rows")


def _points(given: Dict[str, Any]) -> None:
    """One point (l, x), or an array of them."""
    at = given.get("at")
    if at is not None and not isinstance(at, str):
        points = doubles("at", at)
        if points.size and (points.ndim not in (1, 2) or points.shape[-1] != 2):
            raise _errors.BadArgument(f"at has shape {points.shape}, it must be (starts, 2): l, x")
        given["at"] = points.reshape(-1, 2) if points.size else np.empty(0)


#: keys of a scene, and options that say the same
_KEYS_OF_SCENES = {"tolerance": "tol", "end": "t_end"}


def _make(study: str) -> Callable[..., Any]:
    signature, make = _signature(study), _RETURNS.get(study, (_first, "", ""))[0]

    def instrument(*arguments: Any, **keywords: Any) -> Any:
        for key, option in _KEYS_OF_SCENES.items():
            if key in keywords and option in signature.parameters and option not in keywords:
                keywords[option] = keywords.pop(key)
        try:
            bound = signature.bind(*arguments, **keywords).arguments
        except TypeError as error:
            raise TypeError(f"{study}() {error}: it takes {', '.join(signature.parameters)}") from None
        given = {key: bound[key] for key in (*keywords, *bound)}  # as they are written, for the line `command`
        scene, progress, table = given.pop("scene", None), given.pop("progress", None), given.pop("table", None)
        columns = given.pop("columns", None)
        told = explained(scene) if study == "explain" else None
        if told is not None and given:
            raise _errors.BadArgument(f"{next(iter(given))} is for scenes: explain takes a sweep without options")
        if told is not None:
            return told
        _points(given)
        _guard(study, given)
        record = None
        if table is not None:
            record = as_record(as_table(table, columns))
        return ask(study, scene, record, given, make, progress)

    instrument.__name__ = instrument.__qualname__ = study
    instrument.__module__ = "isoroll"
    instrument.__doc__ = _doc(study, signature)
    instrument.__signature__ = signature  # type: ignore[attr-defined]
    instrument.__annotations__ = {p.name: p.annotation for p in signature.parameters.values()}
    return instrument


INSTRUMENTS: Dict[str, Callable[..., Any]] = {name: _make(name) for name in STUDIES if name not in ("run", "convert")}
globals().update(INSTRUMENTS)
__all__ = list(INSTRUMENTS)
