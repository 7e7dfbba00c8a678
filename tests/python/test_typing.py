# What is here: the type hints of the package against the package itself (mypy, stubtest), and that they catch a mistake.
# What is not: what the functions do.
import os
import subprocess
import sys
import unittest
from pathlib import Path

import perfora

from stub_docs import stub_with_docs
from support import FolderTest, needs

needs("mypy")

# What stubtest cannot know of classes that pybind11 makes.
of_pybind11 = (" is inconsistent, metaclass differs", '.__init__ is inconsistent, stub does not have *args argument "args"')

RIGHT = """
import perfora
evaluation = perfora.evaluate({"layout": {"diameter": "7 mm"}}, progress=lambda now: now.strain < 0.1)
peak: float = float(evaluation.stress.max())
print(evaluation.measures["plateau_stress"].unit, peak)
for trial in perfora.Study("s.toml", "out").ask(4):
    print(trial.evaluate(threads=2).status == "completed")
"""
WRONG = """
import perfora
perfora.evaluate({}, replicate="1")
perfora.evaluate({}).curvature
"""


class TypingTest(FolderTest):
    def mypy(self, *arguments):
        environment = {**os.environ, "MYPYPATH": os.environ["PYTHONPATH"]}
        return subprocess.run(
            [sys.executable, "-m", *arguments], cwd=self.folder, env=environment, capture_output=True, text=True, check=False
        )

    def test_hints_are_those_of_the_module(self):
        done = self.mypy("mypy.stubtest", "--concise", "perfora._core")
        wrong = [line for line in done.stdout.splitlines() if line and not line.endswith(of_pybind11)]
        wrong = [line for line in wrong if not line.startswith("Found ")]
        self.assertEqual(wrong, [], done.stderr)
        self.assertIn("perfora._core.Table", done.stdout)  # it did look

    def test_docstrings_are_those_of_the_module(self):
        stub = Path(__file__).parents[2] / "bindings" / "perfora" / "_core.pyi"
        text = stub.read_text()
        self.assertEqual(stub_with_docs(text, perfora._core), text, "renew it with tests/python/stub_docs.py")

    def test_programs_are_checked(self):
        (self.folder / "right.py").write_text(RIGHT)
        (self.folder / "wrong.py").write_text(WRONG)
        right = self.mypy("mypy", "--strict", "-p", "perfora", "-m", "right")
        self.assertEqual(right.returncode, 0, right.stdout + right.stderr)
        wrong = self.mypy("mypy", "--strict", "wrong.py")
        self.assertIn('wrong.py:3: error: Argument "replicate" to "evaluate" has incompatible type "str"', wrong.stdout)
        self.assertIn('wrong.py:4: error: "Evaluation" has no attribute "curvature"', wrong.stdout)


if __name__ == "__main__":
    unittest.main()
