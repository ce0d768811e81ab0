"""Blanking, shearing and cutting of metal by the constrained natural element method.

    import cnem
    case = cnem.load("cases/blanking/sheet", {"let.clearance": "0.1 mm"})
    print(case.check())
    run = case.run(on_output=lambda run: print(run.time, run.nodes))
    run.history["punch.force_y"], run.field("plastic_strain"), run.metrics

Nothing is printed, and nothing written without an output folder. docs/python.md tells the rest.
"""

import os as _os

# libgomp reads this when it is loaded: by default its threads spin at every barrier, and on a busy machine keep the
# cores from each other. A choice of the user stands; the environment is left as it was.
_SPIN = "GOMP_SPINCOUNT"
_ours = _SPIN not in _os.environ and "OMP_WAIT_POLICY" not in _os.environ
if _ours:
    _os.environ[_SPIN] = "1000"
try:
    from . import _cnem
finally:
    if _ours:
        del _os.environ[_SPIN]

from .case import Case, Check, load, quantity
from .errors import DivergedError, Error, InputError, IoError
from .run import History, Output, Run, restart

__version__ = _cnem.version()
__all__ = [
    "Case",
    "Check",
    "DivergedError",
    "Error",
    "History",
    "InputError",
    "IoError",
    "Output",
    "Run",
    "load",
    "quantity",
    "restart",
    "schema",
]


def schema():
    """The JSON Schema of case files, as text."""
    return _cnem.schema()
