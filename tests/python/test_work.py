# What is here: packing and evaluating in Python: numbers, views without copies, progress, Ctrl-C, threads, pickles. What
# is not: whether the numbers are right (tests/solver, tests/verification).
import gc
import json
import math
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
import perfora

from support import FolderTest, program, run, small


class EvaluateTest(FolderTest):
    @classmethod
    def setUpClass(cls):
        cls.evaluation = perfora.evaluate(small)

    def test_numbers_are_those_of_the_program(self):
        file = self.folder / "d.toml"
        file.write_text(perfora.Design(small).to_toml())
        record = json.loads(run(program, "evaluate", file, "-o", self.folder / "r.h5", "--json", "--quiet"))
        for key, measure in self.evaluation.measures.items():
            wanted = record[key]
            if wanted is not None:
                self.assertEqual(measure.value, wanted, key)
            self.assertEqual(self.evaluation[key] if wanted is not None else None, wanted)
        plateau = self.evaluation.measures["plateau_stress"]
        self.assertEqual((plateau.unit, plateau.dimension, float(plateau)), ("Pa", "stress", record["plateau_stress"]))
        rows = np.genfromtxt(self.folder / "r.csv", delimiter=",", names=True)
        np.testing.assert_array_equal(self.evaluation.stress, rows["stress_yy"])
        self.assertEqual(self.evaluation.record["schema"], "perfora.evaluate/1")
        self.assertEqual(self.evaluation.status, "completed")

    def test_score_of_one_and_of_several(self):
        cap_ratio = self.evaluation["cap_ratio"]
        wish = perfora.Design(small, {"target.limit.cap_ratio": cap_ratio / 2, "target.weight.cap_ratio": 0})
        wanted = math.log(0.05) ** 2 + math.log(2) ** 2  # docs/user/theory.md, "Score"
        self.assertAlmostEqual(perfora.score(wish, self.evaluation), wanted)
        self.assertAlmostEqual(perfora.score(wish, (one for one in [self.evaluation] * 2)), wanted)
        with self.assertRaisesRegex(perfora.InputError, "nothing is wished"):
            perfora.score(small, self.evaluation)

    def test_arrays_are_views_that_keep_their_owner(self):
        evaluation = perfora.evaluate(small)
        stress, again = evaluation.stress, evaluation.curve["stress_yy"]
        self.assertTrue(np.shares_memory(stress, again))
        self.assertFalse(stress.flags.owndata)
        self.assertFalse(stress.flags.writeable)
        with self.assertRaises(ValueError):
            stress[0] = 1.0
        with self.assertRaises(ValueError):
            stress.flags.writeable = True
        wanted = stress.copy()
        del evaluation, again
        gc.collect()
        _ = [np.full(100_000, 7.0) for _ in range(20)]  # would be put where freed memory was
        np.testing.assert_array_equal(stress, wanted)

    def test_progress_tells_strain_and_stress_in_the_calling_thread(self):
        heard, threads = [], set()

        def progress(now):
            heard.append((now.fraction, now.strain, now.stress))
            threads.add(threading.get_ident())

        perfora.evaluate(small, progress=progress)
        compression = [(strain, stress) for _, strain, stress in heard if not math.isnan(strain)]
        self.assertGreater(len(compression), 3)
        self.assertAlmostEqual(compression[-1][0], 0.01, places=6)
        self.assertGreater(compression[-1][1], 0.0)
        self.assertEqual(threads, {threading.get_ident()})

    def test_false_stops_a_run_that_then_goes_on_to_the_same_bits(self):
        file = self.folder / "r.h5"
        stopped = perfora.evaluate(small, run_file=file, progress=lambda now: not now.strain >= 0.004)
        self.assertEqual(stopped.status, "stopped")
        self.assertLess(stopped["final_strain"], 0.006)
        with self.assertRaises(perfora.InputError):
            perfora.evaluate(small, run_file=file)
        resumed = perfora.evaluate(small, run_file=file, resume=True)
        self.assertEqual(resumed.status, "completed")
        np.testing.assert_array_equal(resumed.stress, self.evaluation.stress)

    def test_exception_of_the_callback_comes_out(self):
        def progress(now):
            if now.strain >= 0.004:
                raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            perfora.evaluate(small, progress=progress)

    def test_other_threads_run_while_it_computes(self):
        counted = [0]
        done = threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = counted[0]
        perfora.evaluate({**small, "loading": {"until": 0.05, "rate": 10}}, threads=1)
        after = counted[0]
        done.set()
        thread.join()
        # A run of a tenth of a second or more; a thread that waits for its end counts to one or two.
        self.assertGreater(after - before, 10)

    def test_threads_of_python_evaluate_side_by_side(self):
        found = [None, None]

        def work(k):
            found[k] = perfora.evaluate(small, replicate=k, threads=1).stress

        threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(found[0], self.evaluation.stress)
        self.assertFalse(np.array_equal(found[0], found[1]))

    def test_pickle_and_json_give_the_same_back(self):
        for back in (
            pickle.loads(pickle.dumps(self.evaluation)),
            perfora.Evaluation.from_json(self.evaluation.to_json(with_curve=True)),
        ):
            np.testing.assert_array_equal(back.stress, self.evaluation.stress)
            self.assertEqual(back.record, self.evaluation.record)
            self.assertEqual(back.to_json(with_curve=True), self.evaluation.to_json(with_curve=True))
        with self.assertRaises(perfora.InputError):
            perfora.Evaluation.from_json("{}")

    def test_wishes_have_a_verdict(self):
        evaluation = perfora.evaluate(small, threads=1)
        self.assertEqual(evaluation.verdict.outcome, "")
        plateau = evaluation["plateau_stress"]
        wish = {"target.plateau_stress": plateau, "target.tolerance": 0.1, "target.window": [0.002, 0.008]}
        verdict = perfora.evaluate(perfora.Design(small, wish)).verdict
        self.assertIn("plateau stress", verdict.text)
        self.assertNotEqual(verdict.outcome, "")

    def test_unknown_names_are_errors_that_name_the_nearest(self):
        with self.assertRaisesRegex(perfora.InputError, 'did you mean "plateau_stress"'):
            self.evaluation["plateau_stres"]
        with self.assertRaisesRegex(perfora.InputError, 'did you mean "stress_yy"'):
            self.evaluation.curve["stress_y"]

    def test_failing_surroundings_are_os_errors(self):
        # Files may not grow beyond 10 kB: a disk that is full, to the program.
        code = (
            "import resource, sys, perfora\n"
            "resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))\n"
            "try:\n"
            f"    perfora.pack({small!r}, file={str(self.folder / 'p.h5')!r})\n"
            "except OSError as error:\n"
            "    print(type(error).__name__, error)\n"
        )
        said = run(sys.executable, "-c", code)
        self.assertIn("SurroundingsError", said)
        self.assertIn("p.h5", said)
        self.assertTrue(issubclass(perfora.InputError, ValueError))


class InterruptTest(FolderTest):
    def test_ctrl_c_leaves_a_checkpoint_that_goes_on(self):
        file = self.folder / "r.h5"
        long = {**small, "loading": {"until": 0.05, "rate": 2}}
        code = (
            "import sys, perfora\n"
            f"design = perfora.Design({long!r})\n"
            "try:\n"
            f"    perfora.evaluate(design, run_file={str(file)!r}, threads=1,\n"
            "                     progress=lambda now: print(now.strain, flush=True))\n"
            "except KeyboardInterrupt:\n"
            "    sys.exit(42)\n"
        )
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as child:
            for line in child.stdout:
                if float(line) > 0.0:
                    break
            sent = time.monotonic()
            child.send_signal(signal.SIGINT)
            child.stdout.read()
            self.assertEqual(child.wait(60), 42)
        self.assertLess(time.monotonic() - sent, 10.0)
        resumed = perfora.evaluate(perfora.Design(long), run_file=file, resume=True, wall_time=0.05)
        self.assertGreater(resumed["final_strain"], 0.0)  # not from the beginning


class PackTest(FolderTest):
    def test_discs_openings_and_measures(self):
        file = self.folder / "p.h5"
        packing = perfora.pack(small, file=file)
        self.assertEqual(packing.status, "completed")
        discs = packing.discs
        self.assertEqual(len(discs), len(discs.x))
        self.assertLess(len(discs), len(packing.periodic))
        # The hole of 6 mm in the middle of 12 mm is free of discs' centres, and its outline is a circle.
        self.assertTrue(np.all(np.hypot(discs.x - 0.006, discs.y - 0.006) >= 0.003))
        (hole,) = packing.openings
        np.testing.assert_allclose(np.hypot(hole.x - 0.006, hole.y - 0.006), 0.003, rtol=1e-12)
        self.assertAlmostEqual(packing["porosity"], math.pi * 0.25 * 0.5**2, places=12)
        self.assertEqual(packing.measures["thinnest_wall"].unit, "m")
        read = perfora.read(file)
        np.testing.assert_array_equal(read.discs.radius, discs.radius)
        x = perfora.read(file).discs.x  # of an object that is gone
        gc.collect()
        np.testing.assert_array_equal(x, discs.x)

    def test_false_stops_a_packing(self):
        # Another seed: packings are remembered.
        packing = perfora.pack(perfora.Design(small, {"seeds.seed": 977}), progress=lambda now: False)
        self.assertIn(packing.status, ("stopped", "completed"))
        if packing.status == "stopped":
            self.assertEqual(len(packing.discs), 0)

    def test_false_of_numpy_stops_a_run_and_none_does_not(self):
        design = perfora.Design(small)
        stopped = perfora.evaluate(design, progress=lambda now: np.bool_(now.strain <= 0.002))
        self.assertEqual(stopped.status, "stopped")
        self.assertLess(stopped["final_strain"], design["loading.until"])
        self.assertEqual(perfora.evaluate(design, progress=lambda now: None).status, "completed")


if __name__ == "__main__":
    unittest.main()
