# What is here: campaigns in Python, studies that ask and are told, in any order and from other processes. What is not:
# what a search asks (tests/optimize).
import multiprocessing
import unittest

import numpy as np
import perfora

from support import FolderTest, small

STUDY = """
[study]
design = "design.toml"
maxeval = 3
replicates = 2
final_replicates = 2
[target]
plateau_stress = "1 MPa"
window = [0.002, 0.008]
[variables]
layout.diameter = ["4 mm", "7 mm"]
"""


def evaluate(trial):
    return trial, trial.evaluate()


class CampaignTest(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder / "design.toml").write_text(perfora.Design(small).to_toml())
        self.study = self.folder / "study.toml"
        self.study.write_text(STUDY)

    def run_study(self, name):
        return perfora.run_campaign(self.study, self.folder / name, workers=1, threads=1, best_run_file=False)

    def same(self, a, b):
        """All but wall times."""
        self.assertEqual(a.rows.keys(), b.rows.keys())
        for column in a.rows:
            self.assertEqual(a.rows.texts(column), b.rows.texts(column), column)
        self.assertEqual(a.best, b.best)
        self.assertEqual(a.verdict.text, b.verdict.text)

    def test_asked_and_told_is_the_study_that_evaluates_by_itself(self):
        by_itself = self.run_study("by-itself")
        self.assertEqual((by_itself.kind, by_itself.status), ("study", "completed"))
        study = perfora.Study(self.study, self.folder / "told")
        asked = 0
        while not study.finished:
            trials = study.ask()
            self.assertTrue(trials)
            self.assertEqual(study.ask(), [])  # all were given
            asked += len(trials)
            for trial in reversed(trials):  # in any order
                study.tell(trial, trial.evaluate())
        told = study.close()
        self.assertEqual(told.status, "completed")
        self.same(told, by_itself)
        self.assertGreater(asked, 6)
        self.assertEqual(study.ask(), [])

    def test_a_study_that_was_closed_goes_on(self):
        whole = self.run_study("whole")
        with perfora.Study(self.study, self.folder / "parts") as study:
            (trial,) = study.ask(1)
            study.tell(trial, trial.evaluate())
            study.tell(trial, trial.evaluate())  # twice: left alone
        read = perfora.read(self.folder / "parts")
        self.assertEqual((read.kind, read.status), ("study", "stopped"))
        with self.assertRaisesRegex(perfora.InputError, "resume"):
            perfora.Study(self.study, self.folder / "parts")
        context = multiprocessing.get_context("spawn")
        with perfora.Study(self.study, self.folder / "parts", resume=True) as study, context.Pool(1) as pool:
            while not study.finished:
                trials = study.ask()
                self.assertNotIn(trial.key, [one.key for one in trials])
                for one, evaluation in pool.imap_unordered(evaluate, trials):
                    study.tell(one, evaluation)
        self.same(perfora.read(self.folder / "parts"), whole)

    def test_wrong_answers_are_refused(self):
        with perfora.Study(self.study, self.folder / "told") as study:
            first, second = study.ask(2)
            self.assertEqual(study.ask(again=True)[0].key, first.key)
            evaluation = first.evaluate()
            with self.assertRaisesRegex(perfora.InputError, "of something else"):
                study.tell(second, evaluation)  # another replicate
            shorter = perfora.evaluate(first.design.with_changes({"loading.until": 0.009}), replicate=first.replicate)
            with self.assertRaisesRegex(perfora.InputError, "of something else"):
                study.tell(first, shorter)
            stopped = perfora.evaluate(first.design, replicate=first.replicate, progress=lambda now: not now.strain > 0.002)
            with self.assertRaisesRegex(perfora.InputError, "stopped"):
                study.tell(first, stopped)
            study.tell(first, evaluation)
            with self.assertRaisesRegex(perfora.InputError, "in use|used by|another process|holds"):
                perfora.Study(self.study, self.folder / "told", resume=True)
        with self.assertRaisesRegex(perfora.InputError, "closed"):
            study.tell(second, second.evaluate())
        with self.assertRaisesRegex(perfora.InputError, "is no study"):
            perfora.Study(self.folder / "design.toml", self.folder / "x")

    def test_ensemble_and_sweep(self):
        ensemble = perfora.run_ensemble(small, 2, self.folder / "ensemble", threads=1)
        alone = perfora.evaluate(small, replicate=1, threads=1)
        self.assertEqual(ensemble.rows["plateau_stress"][1], alone["plateau_stress"])
        sweep = self.folder / "sweep.toml"
        sweep.write_text('[sweep]\ndesign = "design.toml"\n[grid]\nlayout.diameter = ["5 mm", "6 mm"]\n')
        heard = []
        options = {"workers": 1, "threads": 1}
        stopped = perfora.run_campaign(
            sweep, self.folder / "out", progress=lambda now: heard.append(now.remaining) is not None, **options
        )
        self.assertEqual(stopped.status, "stopped")
        self.assertTrue(heard)
        found = perfora.run_campaign(sweep, self.folder / "out", resume=True, **options)
        self.assertEqual(found.status, "completed")
        self.assertEqual(found.rows.texts("label"), ["diameter 5 mm", "diameter 6 mm"])
        np.testing.assert_array_equal(found.rows["layout.diameter"], [0.005, 0.006])
        self.assertIsNone(found.best)


if __name__ == "__main__":
    unittest.main()
