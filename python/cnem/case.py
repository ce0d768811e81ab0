"""Cases: read from files or built from dicts, and checked."""

import copy
import html
import os

from . import _cnem
from ._html import picture, table
from .errors import InputError


def _merged(overrides, more):
    """Overrides one after the other, as a list of dicts' items or texts keeps them."""
    result = {} if overrides is None else overrides
    if more is None or not more:
        return result
    if isinstance(result, dict) and isinstance(more, dict):
        # What comes later holds, and comes later in the order too.
        return {**{key: value for key, value in result.items() if key not in more}, **more}
    raise TypeError("overrides: expected dicts to join")


class Check:
    """What `cnem check` tells of a case.

    warnings: what is allowed and hardly meant, a sentence each.
    facts: [(label, text)], in the order they are printed; a text goes on under an empty label.
    numbers: {name: float} in SI: nodes, points, steps (expected), first_step (s), seconds (of one thread) ...
    variables: {name: text} of [let].
    """

    def __init__(self, told, variables):
        self.warnings = told["warnings"]
        self.facts = told["facts"]
        self.numbers = told["numbers"]
        self.variables = dict(variables)

    def __str__(self):
        lines = [f"variable    {name} = {text}" for name, text in self.variables.items()]
        lines += ["warning: " + text for text in self.warnings]
        return "\n".join(lines + [f"{label:<11} {text}" for label, text in self.facts])

    def __repr__(self):
        return f"<cnem.Check: {len(self.warnings)} warnings, {self.numbers['nodes']:.0f} nodes>"

    def _repr_html_(self):
        warnings = "".join(f"<p><b>warning:</b> {html.escape(text)}</p>" for text in self.warnings)
        return warnings + table(self.facts)


class Case:
    """A case that has been read and checked against the schema (docs/case_reference.md). It stays as it is.

    Case(tables) builds it from nested dicts as a TOML file has them: values are bool, int, float, str with
    units ("2 mm"), lists, dicts, and NumPy numbers and arrays; a path is a str.
    name: what results are named after. folder: where files that the case names are found.
    overrides: {"time.end": "2 us"}, or a list ["time.end=2 us"] as after `--set`.
    Raises InputError with the texts of the program; their place is "dict" or "override KEY".
    """

    def __init__(self, tables, *, name="case", folder=".", overrides=None):
        if not isinstance(tables, dict):
            raise TypeError("tables: expected a dict; cnem.load(path) reads a file")
        path = os.path.join(folder, name + ".toml")
        kept = copy.deepcopy(tables)
        self._remake = lambda changes: _cnem.Case.build(kept, path, changes)
        self._set_up(overrides)

    @classmethod
    def load(cls, path, overrides=None):
        """Reads a case file, or case.toml in a folder. Raises InputError and IoError."""
        file = os.fspath(path)
        if os.path.isdir(file) and os.path.exists(os.path.join(file, "case.toml")):
            file = os.path.join(file, "case.toml")
        case = cls.__new__(cls)
        case._remake = lambda changes: _cnem.Case.read(file, changes)
        case._set_up(overrides)
        return case

    def _set_up(self, overrides):
        self._overrides = copy.deepcopy(overrides)
        self._core = self._remake(self._overrides)
        self._page = None

    def with_(self, overrides):
        """The same case with further overrides, a dict: case.with_({"let.clearance": "0.1 mm"})."""
        case = Case.__new__(Case)
        case._remake = self._remake
        case._set_up(_merged(self._overrides, overrides))
        return case

    name = property(lambda self: self._core.name, doc="What results are named after.")
    title = property(lambda self: self._core.title, doc="Free text of the case.")
    path = property(lambda self: self._core.path, doc="File it was read from, or stands for.")
    method = property(lambda self: self._core.method, doc="Name of the method.")
    dimensions = property(lambda self: self._core.dimensions, doc="2 or 3.")
    end = property(lambda self: self._core.end, doc="End of the run, s.")
    resolved = property(lambda self: self._core.resolved, doc="The whole case in SI units with defaults, as TOML.")
    variables = property(lambda self: self._core.variables, doc="{name: (value in SI, unit)} of [let].")
    warnings = property(lambda self: self._core.warnings, doc="What reading it already warns of.")

    def check(self, *, output=None, threads=0):
        """Builds geometry and model without running. Returns a Check.

        output: folder whose `initial` gets the first fields; None: nothing is written.
        Raises InputError for what only geometry can tell.
        """
        told = self._core.check("" if output is None else os.fspath(output), threads)
        if told["fault"]:
            raise InputError(told["fault"])
        return Check(told, self._core.variable_texts)

    def start(self, **options):
        """A Run of this case at its start: Run(case, **options)."""
        from .run import Run

        return Run(self, **options)

    def run(self, on_output=None, **options):
        """Runs it to the end: Run(case, **options).run(on_output). Returns the Run."""
        return self.start(**options).run(on_output)

    def __repr__(self):
        return f"<cnem.Case '{self.name}': {self.method}, to {self.end:g} s>"

    def _repr_html_(self):
        """The cloud as it begins, and the numbers of a check: builds the model once."""
        if self._page is None:
            told = self.check()
            rows = list(told.variables.items()) + told.facts
            warnings = "".join(f"<p><b>warning:</b> {html.escape(text)}</p>" for text in told.warnings)
            self._page = warnings + picture(self.start()) + table(rows)
        return self._page


def quantity(values, unit):
    """Numbers with a unit, as cases have them: quantity(2.5, "mm") is "2.5 mm", a vector "4.0 2.0 mm", and an
    array [point, component] a list of such texts. Every digit is kept."""
    if hasattr(values, "tolist"):
        values = values.tolist()
    if isinstance(values, (list, tuple)):
        if values and isinstance(values[0], (list, tuple)):
            return [quantity(row, unit) for row in values]
        return " ".join(repr(float(value)) for value in values) + " " + unit
    return f"{float(values)!r} {unit}"


def load(path, overrides=None):
    """Case.load(path, overrides): a case from a file, or from the case.toml of a folder."""
    return Case.load(path, overrides)
