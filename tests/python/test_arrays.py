"""What is copied and what not, and how long arrays live."""

import gc
import unittest

import numpy as np
from cases import InFolder, adapted, block, cnem


def address(array):
    return array.__array_interface__["data"][0]


class Views(InFolder):
    def test_fields_that_the_run_keeps_are_not_copied(self):
        run = cnem.Case(block()).start()
        for name in ("temperature", "plastic_strain", "velocity_y", "plastic_rate"):
            one, other = run.field(name), run.field(name)
            self.assertEqual(address(one), address(other), name)
            self.assertTrue(np.shares_memory(one, other), name)
            self.assertIsNotNone(one.base)
            self.assertTrue(one.base.current, name)
            self.assertFalse(one.flags.writeable, name)
            with self.assertRaises(ValueError):
                one[0] = 1.0
        for one, other in zip(run.positions, run.positions):
            self.assertEqual(address(one), address(other))
        speed, (x, _) = run.field("velocity_y"), run.positions
        before = speed.copy(), x.copy()
        run.advance(steps=20)
        self.assertTrue(speed.base.current)  # the view shows the present
        self.assertFalse(np.array_equal(speed, before[0]))
        self.assertFalse(np.array_equal(x, before[1]))

    def test_calculated_fields_are_arrays_of_their_own(self):
        run = cnem.Case(block()).run()
        stress = run.field("stress_yy")
        self.assertFalse(np.shares_memory(stress, run.field("stress_yy")))
        self.assertFalse(stress.base.current)
        self.assertEqual(stress.shape, (run.nodes,))
        moved = run.field("displacement_y")
        self.assertLess(moved.min(), 0.0)
        np.testing.assert_array_equal(run.field("temperature", at="points"), run.field("temperature"))

    def test_points_of_triangles_are_not_nodes(self):
        run = cnem.Case(block(method={"name": "fe-triangles"})).run()
        at_points, at_nodes = run.field("plastic_strain"), run.field("plastic_strain", at="nodes")
        self.assertNotEqual(len(at_points), len(at_nodes))
        self.assertEqual(len(at_nodes), run.nodes)
        self.assertEqual(len(run.cells()), len(at_points))

    def test_names_are_checked(self):
        run = cnem.Case(block()).start()
        with self.assertRaisesRegex(cnem.InputError, "did you mean 'temperature'"):
            run.field("temprature")
        with self.assertRaisesRegex(cnem.InputError, "expected \"nodes\" or \"points\""):
            run.field("temperature", at="cells")
        self.assertIn("stress_xy", run.field_names)
        self.assertNotIn("level", run.field_names)
        self.assertEqual(cnem.Case(adapted()).start().field("level").min() < 0.1, True)
        with self.assertRaises(KeyError):
            run.history["stroke"]

    def test_histories_grow_behind_what_was_handed_out(self):
        run = cnem.Case(block()).start()
        run.advance(until=0.5e-6)
        force = run.history["punch.force_y"]
        rows, copy = len(force), force.copy()
        self.assertEqual(address(force), address(run.history["punch.force_y[N/m]"]))
        self.assertTrue(force.base.current)
        run.run()
        np.testing.assert_array_equal(force, copy)
        self.assertFalse(force.base.current)
        self.assertGreater(len(run.history["punch.force_y"]), rows)
        np.testing.assert_array_equal(run.history["punch.force_y"][:rows], copy)

    def test_cells_fill_the_body(self):
        run = cnem.Case(block()).start()
        cells = run.cells()
        area = 0.0
        for begin, end in zip(cells.begin[:-1], cells.begin[1:]):
            x, y = cells.vertices[cells.index[begin:end]].T
            area += 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)
        self.assertAlmostEqual(area, 8e-6, 15)
        self.assertIs(cells.vertices.base, cells)
        self.assertEqual(address(cells.index), address(cells.index))
        vertices = cells.vertices
        del cells, run
        gc.collect()
        self.assertAlmostEqual(vertices[:, 0].max(), 4e-3, 12)

    def test_far_from_the_origin_places_are_calculated(self):
        tables = block(tools={})
        tables["domain"]["outer"]["rectangle"] = {"from": "100 50 m", "to": "100.004 50.002 m"}
        x, y = cnem.Case(tables).start().positions
        self.assertAlmostEqual(x.max(), 100.004, 9)
        self.assertAlmostEqual(y.min(), 50.0, 9)
        self.assertFalse(x.base.current)


class Lifetimes(InFolder):
    def test_arrays_outlive_their_run(self):
        run = cnem.Case(block()).run()
        names = ("temperature", "stress_yy", "velocity_x")
        arrays = [run.field(name) for name in names] + list(run.positions) + [run.history["time"]]
        copies = [array.copy() for array in arrays]
        del run
        gc.collect()
        cnem.Case(block()).run()  # takes the memory that is free
        for array, copy in zip(arrays, copies):
            np.testing.assert_array_equal(array, copy)
            self.assertFalse(array.base.current)

    def test_arrays_outlive_a_change_of_the_cloud(self):
        run = cnem.Case(adapted()).start(threads=1)
        run.advance(steps=1)
        held = [(run.field("plastic_strain"), run.field("temperature"), *run.positions)]
        sizes = {run.nodes}
        for _ in run:
            held.append((run.field("plastic_strain"), run.field("temperature"), *run.positions))
            sizes.add(run.nodes)
        self.assertGreater(len(sizes), 2, "the cloud was to change")
        self.assertFalse(held[0][0].base.current)
        self.assertTrue(held[-1][0].base.current)
        self.assertEqual(len(held[-1][0]), run.nodes)
        for arrays in held:
            for array in arrays:
                self.assertTrue(np.isfinite(array).all())
        del run
        gc.collect()
        self.assertTrue(all(np.isfinite(array).all() for arrays in held for array in arrays))

    def test_a_page_of_a_run(self):
        run = cnem.Case(block(title="<b>Block</b>")).run()
        page = run._repr_html_()
        self.assertIn("data:image/png;base64,", page)
        self.assertIn("peak_force.punch", page)
        self.assertNotIn("<b>Block", page)
        self.assertTrue(run.picture("temperature", width=400).startswith(b"\x89PNG"))
        with self.assertRaisesRegex(cnem.InputError, "300 to 4000"):
            run.picture(width=10)


if __name__ == "__main__":
    unittest.main()
