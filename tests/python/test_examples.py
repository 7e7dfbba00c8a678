# What is here: the examples of the Python module, run on a small design. What is not: the module (the other tests).
import re
import sys
import unittest

import numpy as np
import perfora

from support import FolderTest, needs, run, small, source

examples = source / "bindings/examples"


class ExamplesTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.design = self.folder / "design.toml"
        self.design.write_text(perfora.Design(small).to_toml())

    def example(self, name, *arguments):
        return run(sys.executable, "-B", examples / f"{name}.py", *arguments)

    def expect_picture(self, file):
        from matplotlib.image import imread

        pixels = imread(file)[..., :3]
        self.assertGreater(np.count_nonzero(np.any(pixels < 0.5, axis=2)), 500)  # something is drawn

    def curve(self):
        """needs matplotlib"""
        text = (examples / "curve.py").read_text()
        lines = [line for line in text.splitlines() if line and not line.startswith("#")]
        self.assertEqual(len(lines), 5)
        self.example("curve", self.design, self.folder / "curve.png")
        self.expect_picture(self.folder / "curve.png")

    def scipy_objective(self):
        """needs scipy"""
        said = self.example("scipy_objective", self.design, 1e6, 4)
        found = [float(number) for number in re.findall(r"diameter ([0-9.]+) mm", said)]
        self.assertGreaterEqual(len(found), 4)
        best = float(re.search(r"best: ([0-9.]+) mm", said).group(1))
        self.assertIn(best, found)
        plateaus = {float(d): float(p) for d, p in re.findall(r"diameter ([0-9.]+) mm: plateau ([0-9.]+) kPa", said)}
        self.assertEqual(min(plateaus, key=lambda d: abs(np.log(plateaus[d] / 1e3))), best)

    def optuna_objective(self):
        """needs optuna"""
        said = self.example("optuna_objective", self.design, 1e6, 3)
        self.assertRegex(said, r"best: \{'layout.family': '\w+', 'layout.diameter': 0.00\d+\}, plateau [0-9.]+ kPa")

    def dask_seeds(self):
        """needs dask scipy"""
        said = self.example("dask_seeds", self.design, 3)
        plateaus = [perfora.evaluate(small, replicate=k)["plateau_stress"] for k in range(3)]
        self.assertIn(f"plateau {np.mean(plateaus) / 1e3:.4g} +- ", said)

    def ask_tell(self):
        """needs numpy"""
        study = self.folder / "study.toml"
        study.write_text(
            '[study]\ndesign = "design.toml"\nmaxeval = 2\nreplicates = 2\nfinal_replicates = 0\n'
            '[target]\nplateau_stress = "1 MPa"\nwindow = [0.002, 0.008]\n'
            '[variables]\nlayout.diameter = ["4 mm", "7 mm"]\n'
        )
        said = self.example("ask_tell", study, self.folder / "out")
        found = perfora.read(self.folder / "out")
        self.assertEqual(found.status, "completed")
        self.assertIn(found.verdict.text or found.reason, said)
        self.assertNotIn("replicate", self.example("ask_tell", study, self.folder / "out"))  # nothing is left

    def paper_figures(self):
        """needs matplotlib"""
        said = self.example("paper_figures", source / "docs/data", self.folder / "figures.png")
        # docs/data/README.md has these peaks, of the runs; samples of the histories, means over 0.05 %, are a little lower.
        of_runs = [520.3, 512.7, 524.1, 475.9, 455.5, 431.4]
        strains = [0.606, 0.538, 0.568, 0.547, 0.483, 0.465]
        found = re.findall(r"seed \d: first peak ([0-9.]+) kPa at ([0-9.]+) %", said)
        self.assertEqual(len(found), 6)
        for (stress, strain), of_run, at in zip(found, of_runs, strains):
            self.assertLess(abs(float(stress) / of_run - 0.975), 0.025)
            self.assertLess(abs(float(strain) - at), 0.051)
        self.expect_picture(self.folder / "figures.png")


if __name__ == "__main__":
    name = sys.argv[1]
    needs(*getattr(ExamplesTest, name).__doc__.split()[1:])
    suite = unittest.TestSuite([ExamplesTest(name)])
    sys.exit(not unittest.TextTestRunner().run(suite).wasSuccessful())
