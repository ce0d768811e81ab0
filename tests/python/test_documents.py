"""The pieces of Python in docs/python.md run one after the other, from the root of the repository."""

import contextlib
import importlib.util
import io
import os
import pathlib
import re
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).parents[2]
SHORTER = {'"250 us"': '"24 us"'}  # to the end of the cut is too long for a test


def pieces(page):
    """(line, text) of each block of Python."""
    text = page.read_text(encoding="utf-8")
    found = re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [(text.count("\n", 0, block.start(1)) + 1, block[1]) for block in found]


class Documents(unittest.TestCase):
    def setUp(self):
        before = os.getcwd()
        os.chdir(ROOT)
        self.addCleanup(os.chdir, before)

    def test_python_page_from_top_to_bottom(self):
        page = ROOT / "docs" / "python.md"
        blocks = pieces(page)
        self.assertGreaterEqual(len(blocks), 5)
        self.assertTrue(all(any(long in text for _, text in blocks) for long in SHORTER), "what is shortened is there")
        names, kept = {"__name__": "__main__"}, {}
        for line, text in blocks:
            if "matplotlib" in text and not importlib.util.find_spec("matplotlib"):
                continue
            for long, short in SHORTER.items():
                text = text.replace(long, short)
            # Lines of the page, for messages.
            code = compile("\n" * (line - 1) + text, str(page), "exec")
            with contextlib.redirect_stdout(io.StringIO()):
                exec(code, names)
            kept.setdefault("run", names["run"])

        first = kept["run"]
        self.assertGreater(names["largest"], 1e6)
        self.assertLess(abs(names["largest"] / first.metrics["peak_force.punch"] - 1.0), 0.01)
        self.assertEqual(len(names["strain"]), len(names["x"]))
        self.assertAlmostEqual(names["block"].check().numbers["area"], 8e-6, 12)
        self.assertEqual([share for share, _ in names["rows"]], [0.02, 0.05, 0.1, 0.15])
        self.assertTrue(all(peak > 1e6 for _, peak in names["rows"]), names["rows"])
        # Not yet broken: the callback let it run, and kept what it was shown.
        self.assertEqual(names["run"].exit_code, 0)
        self.assertTrue(names["frames"] and all(np.isfinite(strain).all() for _, strain in names["frames"]))


if __name__ == "__main__":
    unittest.main()
