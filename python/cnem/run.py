"""Runs: to the end or in pieces, with their fields, histories and numbers."""

import html
import json
import os
from collections import namedtuple
from collections.abc import Mapping

from . import _cnem
from ._html import picture, table
from .errors import DivergedError, InputError, IoError

Output = namedtuple("Output", "time step row frame")
Output.__doc__ = """What has just been made: at `time` (s) and `step`, a row of the history, a frame of the fields."""


class History(Mapping):
    """Rows of the history until now: history["punch.force_y"] is a read-only array [row], without a copy.

    Columns go by their names with units, as in history.csv, or without.
    """

    def __init__(self, core):
        self._core = core

    def _find(self, name):
        columns = self._core.columns()
        if name in columns:
            return columns.index(name)
        bare = [column.split("[")[0] for column in columns]
        return bare.index(name) if name in bare else -1

    def _index(self, name):
        k = self._find(name)
        if k < 0:
            raise KeyError(f"{name}: expected one of {', '.join(self)}")
        return k

    def __getitem__(self, name):
        return self._core.column(self._index(name))

    def __contains__(self, name):
        return self._find(name) >= 0

    def __iter__(self):
        return iter(self._core.columns())

    def __len__(self):
        return len(self._core.columns())

    def unit(self, name):
        """SI unit of a column; "" for a number. Raises KeyError."""
        column = self._core.columns()[self._index(name)]
        return column[len(column.split("[")[0]) + 1 : -1]

    def __repr__(self):
        rows = len(self["time"]) if len(self) else 0
        return f"<cnem.History: {rows} rows of {len(self)} columns>"


class Run:
    """A run of a case, at its start.

    output: folder of results, as `cnem run --output` writes it; None: nothing is written to disk.
    force: replace a run that is there. threads: of parallel loops; 0: as many as OpenMP takes by itself. Results
    do not depend on it.
    Raises InputError and IoError.
    """

    def __init__(self, case, *, output=None, force=False, threads=0):
        self._take(_cnem.Run(case._core, "" if output is None else os.fspath(output), force, threads))

    @classmethod
    def restart(cls, folder, *, threads=0):
        """Goes on with the run in a folder, from its newest good checkpoint, as `cnem restart` does.

        Raises InputError when it holds no run, or one that has finished, and IoError.
        """
        run = cls.__new__(cls)
        run._take(_cnem.Run(os.fspath(folder), threads))
        return run

    def _take(self, core):
        self._core = core
        self.history = History(core)

    # Going on

    def run(self, on_output=None):
        """Goes on to the end.

        on_output(run) is called after each row of the history or frame of the fields, in between of which the
        run can be looked at; False (also NumPy's), or run.stop(), stops it, and so does an exception, which is raised here then.
        Returns self. Raises DivergedError, IoError, InputError, and KeyboardInterrupt after it has stopped in order.
        """
        return self.advance(on_output=on_output)

    def advance(self, *, until=None, steps=None, on_output=None):
        """Goes on until the first step at or beyond `until` (s), for so many `steps`, or to the end.

        It shortens no step for that: the results are those of a run in one go, to the bit. Returns self.
        """
        if self.finished:
            return self
        if steps is not None and steps < 0:
            raise InputError(f"steps: found {steps}, expected 0 or more")
        self._go_on(until=until, steps=steps, on_output=on_output)
        return self

    def __iter__(self):
        """Goes on from output to output: for output in run: ..."""
        while self.exit_code is None:
            self._go_on(output=True)
            if self._core.row or self._core.frame:
                yield self.output

    def _go_on(self, until=None, steps=None, output=False, on_output=None):
        callback = None if on_output is None else lambda row, frame: on_output(self)
        self._core.go_on(until, steps, output, callback)
        if self.exit_code == DivergedError.exit_code:
            error = DivergedError(self.reason)
            error.post_mortem = self.status.get("post_mortem")
            raise error
        if self.exit_code == IoError.exit_code:
            raise IoError(self._core.failed)

    def stop(self):
        """Stops in order: with a checkpoint, status and report where there is a folder, from which
        cnem.restart(folder) goes on; without one, the run itself can go on. From a callback or another thread it
        takes effect before the next step."""
        self._core.stop("stop()")
        if not self._core.going and not self.finished:
            self._go_on()

    # How it stands

    name = property(lambda self: self._core.case_name, doc="Name of the case.")
    dimensions = property(lambda self: self._core.dimensions, doc="2 or 3.")
    time = property(lambda self: self._core.time, doc="s, reached.")
    end = property(lambda self: self._core.end, doc="s, end of the run.")
    step = property(lambda self: self._core.step, doc="Steps made.")
    nodes = property(lambda self: self._core.nodes, doc="Number of nodes.")
    messages = property(lambda self: self._core.messages, doc="What the program would have printed, so far.")
    exit_code = property(lambda self: self._core.exit, doc="0 done, 3 diverged, 4 writing failed, 5 stopped; None: it can go on.")

    @property
    def folder(self):
        """Folder of results; None when nothing is written."""
        return self._core.output or None

    @property
    def finished(self):
        """Whether it cannot go on: it has reached its end, failed, or was stopped with a folder."""
        return self.exit_code not in (None, 5) or (self.exit_code == 5 and self.folder is not None)

    @property
    def output(self):
        """The last output of the latest call."""
        return Output(self.time, self.step, self._core.row, self._core.frame)

    @property
    def status(self):
        """What status.json has, as it stands: metrics, warnings, wall times ..."""
        return json.loads(self._core.status())

    @property
    def reason(self):
        """How the run ended, in words; "" before."""
        return self.status["reason"]

    @property
    def warnings(self):
        return self.status["warnings"]

    @property
    def metrics(self):
        """Named numbers in SI, {"peak_force.punch": ...}; units: metric_units."""
        return self._core.metrics()

    @property
    def metric_units(self):
        return self._core.metric_units()

    # What there is to see

    @property
    def field_names(self):
        """Of docs/case_reference.md, those that this run has."""
        return self._core.field_names()

    def field(self, name, at=None):
        """Values of a field in SI, a read-only array [node] or [point].

        at: "nodes" or "points"; None: where the field lives. No copy where the run keeps the field there
        (array.base.current), else calculated. Raises InputError.
        """
        return self._core.field(name, at or "")

    @property
    def positions(self):
        """Places of the nodes, m: read-only arrays (x, y) or (x, y, z), without a copy; for a workpiece far from
        (0, 0), which is counted from a place of its own, calculated."""
        return self._core.positions()

    def cells(self):
        """Polygons (tetrahedra in space) of the stress points: `vertices`, `begin`, `index`, as they are now."""
        return self._core.cells()

    def picture(self, field=None, width=1400):
        """The cells coloured by a field with the tools, as a PNG (bytes); in the plane. Raises InputError."""
        return self._core.picture(field or "", width)

    def __repr__(self):
        state = {None: "under way", 0: "done", 3: "diverged", 4: "failed", 5: "stopped"}[self.exit_code]
        return f"<cnem.Run '{self.name}': {state}, t = {self.time:g} of {self.end:g} s, {self.nodes} nodes>"

    def _repr_html_(self):
        from numpy import format_float_positional, format_float_scientific

        def number(value):
            small = value != 0 and not 1e-3 <= abs(value) < 1e6
            text = format_float_scientific if small else format_float_positional
            return text(float(f"{value:.4g}"), trim="-")

        status = self.status
        rows = [
            ("state", repr(self)[10:-1]),
            ("steps", self.step),
            ("energy residual", f"{status['energy_residual'] or 0:.2g} of the work"),
        ]
        peaks = {name: value for name, value in self.metrics.items() if name.startswith(("peak_force", "max_"))}
        rows += [(name, f"{number(value)} {self.metric_units.get(name, '')}") for name, value in peaks.items()]
        warnings = "".join(f"<p><b>warning:</b> {html.escape(text)}</p>" for text in status["warnings"])
        return warnings + picture(self) + table(rows)


def restart(folder, *, threads=0):
    """Run.restart(folder): goes on with a run that was stopped or killed."""
    return Run.restart(folder, threads=threads)
