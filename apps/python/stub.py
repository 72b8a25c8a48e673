"""python3 stub.py FILE: writes _instruments.pyi, which shows editors what _instruments.py makes of the library.

The build calls it. ISOROLL_LIBRARY names the library. It needs NumPy, as the package does.
"""

import sys
from pathlib import Path

from isoroll import _instruments

HEAD = '''"""Made by stub.py from the library's tables."""

from typing import Any, Callable, Dict, Literal, Mapping, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike

from ._kinds import Branch, Chaos, Chart, Comparison, Cost, Periodic, Result, Section, Splitting
from ._scene import SceneLike
from ._study import ProgressLike
from ._table import PathLike, Table

TableLike = Union[Table, PathLike]
INSTRUMENTS: Dict[str, Callable[..., Any]]

def python_name(option: str) -> str: ...
'''


def text() -> str:
    """The stub."""
    parts = [HEAD]
    for name, function in _instruments.INSTRUMENTS.items():
        arguments = []
        signature = function.__signature__  # type: ignore[attr-defined]
        starred = False
        for parameter in signature.parameters.values():
            if parameter.kind is parameter.KEYWORD_ONLY and not starred:
                arguments.append("*")
                starred = True
            default = "" if parameter.default is parameter.empty else f" = {parameter.default!r}"
            arguments.append(f"{parameter.name}: {parameter.annotation}{default}")
        listed = "".join(f"    {argument},\n" for argument in arguments)
        doc = (function.__doc__ or "").replace("\\", "\\\\").replace("\n", "\n    ").replace("    \n", "\n")
        parts.append(f'def {name}(\n{listed}) -> {signature.return_annotation}:\n    """{doc}"""\n')
    return "\n".join(parts)


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(text(), encoding="utf-8")
