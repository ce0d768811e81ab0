"""The example notebooks run from their first cell to their last."""

import contextlib
import importlib.util
import io
import json
import os
import pathlib
import re
import unittest

EXAMPLES = pathlib.Path(__file__).parents[2] / "python" / "examples"


def installed(*modules):
    return all(importlib.util.find_spec(module) for module in modules)


class Notebooks(unittest.TestCase):
    def setUp(self):
        self._before = os.getcwd()
        os.chdir(EXAMPLES)
        self.addCleanup(os.chdir, self._before)
        self.files = sorted(EXAMPLES.glob("*.ipynb"))
        self.assertTrue(self.files)

    def test_cells_in_their_order(self):
        for file in self.files:
            notebook = json.loads(file.read_text(encoding="utf-8"))
            names = {"__name__": "__main__"}
            for number, cell in enumerate(notebook["cells"]):
                if cell["cell_type"] != "code":
                    continue
                self.assertEqual(cell["outputs"], [], f"{file.name}: commit it without outputs")
                place = f"{file.name}, cell {number}"
                with self.subTest(place), contextlib.redirect_stdout(io.StringIO()):
                    exec(compile("".join(cell["source"]), place, "exec"), names)
            self.assertLess(names["misfit"], 0.01, "the fit of the last cells")
            self.force_is_shown(names)

    def force_is_shown(self, names):
        """The largest force of the first curve, as `show` prints it without matplotlib: above zero, that of the metrics."""
        names["plt"] = None
        with contextlib.redirect_stdout(io.StringIO()) as text:
            names["show"]({"10 %": names["curve"](names["run"])})
        shown = re.search(r"(-?[0-9.]+) kN/mm at most", text.getvalue())
        self.assertIsNotNone(shown, text.getvalue())
        peak = names["run"].metrics["peak_force.punch"] * 1e-6
        self.assertGreater(peak, 0.5)
        self.assertLess(abs(float(shown[1]) / peak - 1.0), 0.01, f"{text.getvalue()}, metrics: {peak}")

    @unittest.skipUnless(installed("nbclient", "ipykernel"), "needs nbclient and ipykernel")
    def test_as_jupyter_runs_them(self):
        import nbclient
        import nbformat

        for file in self.files:
            nbclient.NotebookClient(nbformat.read(file, as_version=4), timeout=300).execute()


if __name__ == "__main__":
    unittest.main()
