"""Runs: in pieces, with callbacks, stopped, restarted, beside each other, and silent."""

import os
import pathlib
import signal
import subprocess
import sys
import threading
import unittest

import numpy as np
from cases import InFolder, adapted, bits, block, cnem, printed, pulled


class Runs(InFolder):
    def test_in_one_go_without_a_trace(self):
        handlers = {k: signal.getsignal(k) for k in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1)}
        caught = caught_signals()
        environment = dict(os.environ)
        with printed() as texts:
            run = cnem.Case(block()).run(threads=1)
            run._repr_html_()
        self.assertEqual(texts, ["", ""])
        self.assertEqual(self.files(), [])
        self.assertEqual({k: signal.getsignal(k) for k in handlers}, handlers)
        self.assertEqual(caught_signals(), caught)
        self.assertEqual(dict(os.environ), environment)
        self.assertEqual((run.exit_code, run.finished, run.folder), (0, True, None))
        self.assertAlmostEqual(run.time, 2e-6, 15)
        self.assertEqual(len(run.history["time"]), 21)
        self.assertEqual(run.history.unit("punch.force_y"), "N/m")
        with self.assertRaisesRegex(KeyError, "punch.froce: expected one of time"):
            run.history.unit("punch.froce")
        self.assertTrue(any("reached the end" in text for text in run.messages), run.messages)
        self.assertGreater(run.metrics["peak_force.punch"], 0.0)
        self.assertEqual(run.metric_units["peak_force.punch"], "N/m")
        self.assertEqual(run.status["exit"], 0)

    def test_pieces_have_the_bits_of_one_go(self):
        case = cnem.Case(adapted())
        whole = case.run(threads=1)
        pieces = case.start(threads=1)
        pieces.advance(steps=7)
        self.assertEqual(pieces.step, 7)
        pieces.advance(until=0.5e-6)
        self.assertGreaterEqual(pieces.time, 0.5e-6 * (1 - 1e-9))
        self.assertIsNone(pieces.exit_code)
        outputs = list(pieces)
        self.assertEqual(pieces.exit_code, 0)
        self.assertTrue(outputs[-1].row and outputs[-1].frame)
        self.assertEqual(bits(pieces), bits(whole))
        self.assertIs(pieces.advance(), pieces)  # nothing more

    def test_runs_beside_each_other_have_the_bits_of_each_alone(self):
        cases = [cnem.Case(adapted()), cnem.Case(block(time={"end": "1 us"}))]
        alone = [bits(case.run(threads=1)) for case in cases]
        runs = [case.start(threads=1) for case in cases]
        while not all(run.finished for run in runs):
            for run in runs:
                run.advance(steps=1)
        self.assertEqual([bits(run) for run in runs], alone)
        runs = [case.start(threads=1) for case in cases]
        workers = [threading.Thread(target=run.run) for run in runs]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        self.assertEqual([bits(run) for run in runs], alone)

    def test_the_program_has_the_same_history(self):
        program = os.environ.get("CNEM_PROGRAM")
        if not program:
            self.skipTest("CNEM_PROGRAM names no program")
        case = cnem.Case(block())
        pathlib.Path("block.toml").write_text(case.resolved)
        subprocess.run([program, "run", "block.toml", "--output", "told"], check=True, capture_output=True)
        run = case.run()
        rows = np.loadtxt("told/history.csv", delimiter=",", skiprows=1)
        for k, name in enumerate(run.history):
            np.testing.assert_array_equal(rows[:, k], run.history[name], name)

    def test_statics(self):
        run = cnem.Case(pulled()).start()
        self.assertEqual(run.field("displacement_y").max(), 0.0)
        run.run()
        self.assertEqual((run.exit_code, len(run.history["time"])), (0, 1))
        self.assertGreater(run.field("displacement_y").max(), 1e-7)
        self.assertGreater(run.metrics["largest_displacement"], 1e-7)
        self.assertEqual(self.files(), [])


class Callbacks(InFolder):
    def test_numbers_that_mean_nothing(self):
        case = cnem.Case(block())
        with self.assertRaisesRegex(cnem.InputError, "found -1, expected 1 or more"):
            case.run(threads=-1)
        with self.assertRaisesRegex(cnem.InputError, "until: found nan"):
            case.start(threads=1).advance(until=float("nan"))

    def test_after_every_output(self):
        seen = []
        run = cnem.Case(block()).run(lambda run: seen.append((run.output, len(run.history["time"]), run.nodes)))
        self.assertEqual([rows for output, rows, _ in seen if output.row], list(range(1, 22)))
        self.assertEqual(seen[0][0].time, 0.0)
        self.assertEqual(seen[-1][0].time, run.time)
        self.assertGreater(sum(output.frame for output, _, _ in seen), 2)

    def test_stop_and_go_on_in_memory(self):
        case = cnem.Case(block())
        whole = bits(case.run())
        for stop in (
            lambda run: run.time < 1e-6,
            lambda run: np.float64(run.time) < 1e-6,  # of type numpy.bool_
            lambda run: run.stop() if run.time >= 1e-6 else None,
        ):
            run = case.run(stop)
            self.assertEqual((run.exit_code, run.finished), (5, False))
            self.assertLess(run.time, 1.2e-6)
            self.assertIn("by", run.reason)
            self.assertEqual(run.advance(steps=1).reason, "")
            self.assertEqual(bits(run.run()), whole)
            self.assertEqual(run.exit_code, 0)

    def test_an_exception_ends_the_run_in_order_and_comes_through(self):
        case = cnem.Case(block())

        def fail(run):
            if run.time >= 1e-6:
                raise LookupError("as asked")

        run = case.start(output="results")
        with self.assertRaisesRegex(LookupError, "as asked"):
            run.run(fail)
        self.assertEqual((run.exit_code, run.finished), (5, True))
        self.assertIn("LookupError in the callback", run.reason)
        for name in ("checkpoint.h5", "status.json", "report.html"):
            self.assertTrue(pathlib.Path("results", name).exists(), name)
        again = cnem.restart("results").run()
        self.assertEqual(bits(again), bits(case.run()))

    def test_a_callback_may_look_and_not_go_on(self):
        case = cnem.Case(block())

        def go_on(run):
            self.assertEqual(len(run.field("temperature")), run.nodes)
            run.advance(steps=1)

        with self.assertRaisesRegex(RuntimeError, "its own callback"):
            case.run(go_on)

    def test_interrupts(self):
        """SIGINT, while the run is under way in the main thread."""
        script = (
            "import os, signal, sys, threading\n"
            "import cnem\n"
            f"case = cnem.Case({block(time={'end': '20 ms'}, tools={}, output={'history_every': '1 us'})!r})\n"
            "run = case.start(threads=1)\n"
            "threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
            "try:\n"
            "    run.run()\n"
            "except KeyboardInterrupt:\n"
            "    print(run.exit_code, run.reason)\n"
            "    sys.exit(run.advance(steps=1).exit_code is not None)\n"
        )
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.startswith("5 by KeyboardInterrupt at step"), done.stdout)

    def test_another_thread_may_stop_and_not_look(self):
        run = cnem.Case(block(time={"end": "20 ms"}, tools={}, output={"history_every": "1 ms"})).start(threads=1)
        worker = threading.Thread(target=run.run)
        worker.start()
        refused = 0
        try:
            while not run._core.going:
                pass
            for look in (lambda: run.time, lambda: run.field("temperature"), lambda: run.advance(steps=1)):
                with self.assertRaisesRegex(RuntimeError, "another thread"):
                    look()
                refused += 1
            while not run._core.row:
                pass
            self.assertEqual((run.messages, run.exit_code), ([], None))
        finally:
            run.stop()
            worker.join()
        self.assertEqual((run.exit_code, refused), (5, 3))


class Folders(InFolder):
    def test_a_run_with_a_folder_is_that_of_the_program(self):
        case = cnem.Case(block(), name="block")
        with printed() as texts:
            run = case.run(output="results")
        self.assertEqual(texts, ["", ""])
        for name in ("case.resolved.toml", "history.csv", "fields.pvd", "status.json", "report.html"):
            self.assertTrue(pathlib.Path("results", name).exists(), name)
        rows = np.loadtxt("results/history.csv", delimiter=",", skiprows=1)
        np.testing.assert_array_equal(rows[:, 0], run.history["time"])
        with self.assertRaisesRegex(cnem.InputError, "--force"):
            case.start(output="results")
        case.start(output="results", force=True)

    def test_restart(self):
        case = cnem.Case(adapted())
        whole = case.run()
        stopped = case.run(lambda run: run.time < 1e-6, output="results")
        self.assertTrue(stopped.finished)
        run = cnem.restart("results", threads=1)
        self.assertEqual((run.time, run.step), (stopped.time, stopped.step))
        self.assertEqual(len(run.history["time"]), len(stopped.history["time"]))
        self.assertEqual(bits(run.run()), bits(whole))
        with self.assertRaisesRegex(cnem.InputError, "has finished"):
            cnem.restart("results")
        with self.assertRaisesRegex(cnem.InputError, "holds no run"):
            cnem.restart("elsewhere")

    def test_divergence(self):
        tables = block(time={"end": "2 us", "step": {"fixed": "1 us"}})
        run = cnem.Case(tables).start()
        with self.assertRaises(cnem.DivergedError) as caught:
            run.run()
        self.assertEqual((run.exit_code, caught.exception.exit_code), (3, 3))
        self.assertEqual(str(caught.exception), run.reason)
        self.assertTrue(caught.exception.post_mortem["causes"])


def caught_signals():
    """The mask of signals that the process has handlers for."""
    with open("/proc/self/status", encoding="ascii") as status:
        return [line for line in status if line.startswith("SigCgt")]


if __name__ == "__main__":
    unittest.main()
