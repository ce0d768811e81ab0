"""Cases from files and dicts, their errors, and checks."""

import pathlib
import unittest

import numpy as np
from cases import InFolder, block, cnem, pulled

TOML = """
title = "A block"
[let]
width = "4 mm"
half = "0.5 * width"
[time]
end = "2 us"
[domain]
material = "lib:304L"
outer.rectangle = { from = "0 0 mm", to = "width, half" }
[cloud]
spacing = "0.4 mm"
[boundary.base]
pieces = ["bottom"]
symmetry = true
"""


class Cases(InFolder):
    def test_a_file_and_a_folder(self):
        pathlib.Path("block").mkdir()
        pathlib.Path("block/case.toml").write_text(TOML)
        for path in ("block", pathlib.Path("block"), "block/case.toml"):
            case = cnem.load(path)
            self.assertEqual((case.name, case.title, case.dimensions), ("block", "A block", 2))
        self.assertEqual(case.variables["half"], (0.002, "m"))
        self.assertIn("[domain]", case.resolved)

    def test_overrides_as_on_the_command_line_and_as_dicts(self):
        pathlib.Path("block.toml").write_text(TOML)
        case = cnem.load("block.toml", ["time.end=1 us", 'let.width="6 mm"'])
        self.assertEqual((case.end, case.variables["half"][0]), (1e-6, 0.003))
        case = cnem.load("block.toml", {"time.end": "3 us", "let.width": "8 mm"})
        self.assertEqual((case.end, case.variables["half"][0]), (3e-6, 0.004))
        shorter = case.with_({"time.end": "0.5 us"})
        self.assertEqual((shorter.end, shorter.variables["half"][0], case.end), (5e-7, 0.004, 3e-6))

    def test_a_case_stays_what_it_was(self):
        tables, overrides = block(), {"time.end": "1 us"}
        case = cnem.Case(tables, overrides=overrides)
        tables["cloud"]["spacing"] = "0.2 mm"
        overrides["time.end"] = "2 us"
        self.assertEqual(case.with_({"title": "again"}).resolved.count("spacing = \"0.0004 m\""), 1)
        self.assertEqual(case.with_({"title": "again"}).end, 1e-6)

    def test_a_dict_says_the_same_as_a_file(self):
        pathlib.Path("block.toml").write_text(TOML)
        tables = {
            "title": "A block",
            "let": {"width": "4 mm", "half": "0.5 * width"},
            "time": {"end": "2 us"},
            "domain": {
                "material": "lib:304L",
                "outer": {"rectangle": {"from": cnem.quantity(np.zeros(2), "mm"), "to": "width, half"}},
            },
            "cloud": {"spacing": cnem.quantity(np.float64(0.4), "mm")},
            "boundary": {"base": {"pieces": ("bottom",), "symmetry": np.bool_(True)}},
        }
        built, read = cnem.Case(tables, name="block"), cnem.load("block.toml")
        without_file = [case.resolved.split("\n", 1)[1] for case in (built, read)]
        self.assertEqual(*without_file)

    def test_arrays_are_lists_of_points(self):
        corners = cnem.quantity(np.array([[4.0, 0.0], [4.0, 2.0], [0.0, 2.0]]), "mm")
        outer = {"start": "0 0 mm", "path": [{"to": corner} for corner in corners]}
        case = cnem.Case(block(domain={"material": "lib:304L", "outer": outer}, boundary={}))
        self.assertAlmostEqual(case.check().numbers["area"], 8e-6, 15)
        nodes = np.stack(np.meshgrid(np.arange(11.0), np.arange(6.0)), axis=-1).reshape(-1, 2) * 0.4e-3
        listed = cnem.Case(block(cloud={"pattern": "list", "nodes": cnem.quantity(nodes, "m")}))
        self.assertEqual(listed.check().numbers["nodes"], 66)


class Errors(InFolder):
    def refused(self, text, make, *arguments, **options):
        with self.assertRaises(cnem.InputError) as caught:
            make(*arguments, **options)
        self.assertIn(text, str(caught.exception))
        self.assertEqual(caught.exception.exit_code, 2)
        self.assertIsInstance(caught.exception, ValueError)
        return caught.exception

    def test_the_texts_are_those_of_the_program(self):
        wrong = block(tiem={"end": "1 us"})
        wrong["cloud"] = {"spacing": "0.4 kg"}
        error = self.refused("dict: key 'tiem'", cnem.Case, wrong)
        self.assertIn("did you mean 'time'", str(error))
        self.assertTrue(any("cloud.spacing" in line for line in error.messages), error.messages)
        pathlib.Path("bad.toml").write_text("[time]\nend = 3\nend = 4\n")
        self.refused("bad.toml:3:7", cnem.load, "bad.toml")
        self.refused("no such file", cnem.load, "absent.toml")
        self.refused("override tme.end", cnem.Case, block(), overrides={"tme.end": "1 us"})
        self.refused("expected key=value", cnem.Case, block(), overrides=["time"])

    def test_values_that_no_case_can_have(self):
        for value, found in (
            (None, "None"),
            ({1, 2}, "an object of type set"),
            (2**70, "a whole number of 64 bits"),
            ({1: 2}, "a key of type int"),
        ):
            self.refused(found, cnem.Case, block(time={"end": value}))
        endless = []
        endless.append(endless)
        self.refused("more than 64 deep", cnem.Case, block(title=endless))
        with self.assertRaises(TypeError):
            cnem.Case("case.toml")

    def test_what_only_geometry_can_tell(self):
        far = {"probes": {"far": {"at": "1 1 m", "fields": ["temperature"]}}}
        self.refused("output.probes.far.at", cnem.Case, block(output=far))
        loose = pulled()
        del loose["boundary"]["base"]
        self.refused("boundary", cnem.Case(loose).check)

    def test_exceptions_of_one_kind(self):
        self.assertTrue(issubclass(cnem.IoError, (cnem.Error, OSError)))
        self.assertEqual((cnem.DivergedError.exit_code, cnem.IoError.exit_code), (3, 4))
        pathlib.Path("folder").write_text("a file")
        with self.assertRaises(cnem.IoError):
            cnem.Case(block()).start(output="folder/results")


class Checks(InFolder):
    def test_warnings_and_numbers(self):
        tables = block()
        tables["output"]["pictures"] = ["1 us", "5 us"]
        check = cnem.Case(tables).check()
        self.assertEqual(self.files(), [])
        self.assertTrue(any("pictures" in text for text in check.warnings), check.warnings)
        self.assertEqual(check.numbers["nodes"], 78)
        self.assertGreater(check.numbers["steps"], 10)
        self.assertIn("first step", dict(check.facts))
        self.assertIn("nodes       78\n", str(check))
        self.assertIn("<table>", check._repr_html_())

    def test_first_fields_where_they_are_wanted(self):
        cnem.Case(block()).check(output="looked_at")
        self.assertTrue(pathlib.Path("looked_at/initial/fields.pvd").exists())

    def test_statics(self):
        check = cnem.Case(pulled()).check()
        self.assertEqual(check.numbers["unknowns"], 2 * check.numbers["nodes"])

    def test_a_notebook_shows_the_cloud(self):
        page = cnem.Case(block())._repr_html_()
        self.assertIn("data:image/png;base64,", page)
        self.assertIn("<td style=\"text-align:left\">nodes</td>", page)
        self.assertLess(len(page), 200_000)


if __name__ == "__main__":
    unittest.main()
