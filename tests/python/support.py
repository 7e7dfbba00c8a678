# What is here: a design small enough to be evaluated in a second, a folder that goes away, skipping. What is not: tests.
import importlib
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

source = Path(__file__).resolve().parents[2]
program = os.environ.get("PERFORA_PROGRAM", "")
skipped = 77  # exit code that CTest takes for "skipped"

# One hole of 6 mm in 12 x 12 mm, some 380 discs, pressed fast and not far.
small = {
    "cell": {"width": "12 mm", "height": "12 mm"},
    "layout": {"family": "square", "rows": 1, "columns": 1, "diameter": "6 mm"},
    "packing": {"solid_fraction": 0.719},
    "loading": {"until": 0.01, "rate": 40},
    "measures": {"plateau_start": 0.002, "plateau_end": 0.008},
}


class FolderTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        made = tempfile.TemporaryDirectory(prefix="perfora-python-")
        self.addCleanup(made.cleanup)
        self.folder = Path(made.name)


def needs(*modules):
    """Ends the program as skipped, and says so, where a module is missing."""
    for name in modules:
        try:
            importlib.import_module(name)
        except ImportError:
            print(f"skipped: the Python module {name} is not installed")
            sys.exit(skipped)


def run(*command):
    """Its standard output; what it says where it fails is the test's message."""
    done = subprocess.run([str(part) for part in command], check=False, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout
