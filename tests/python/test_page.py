# What is here: the programs of docs/user/python.md, run as they stand. What is not: the examples that it names
# (test_examples.py).
import os
import re
import unittest
from unittest import mock

import perfora

from support import FolderTest, source


class PageTest(FolderTest):
    def test_tour_runs(self):
        text = (source / "docs/user/python.md").read_text(encoding="utf-8")
        (tour,) = re.findall(r"\n```python\n(.*?)\n```\n", text, re.DOTALL)
        # Shorter and faster than the page's, which takes some seconds on an idle machine.
        fast = tour.replace('"loading.until"] = 0.05', '"loading.until"] = 0.01')
        self.assertNotEqual(fast, tour)
        os.chdir(self.folder)
        (self.folder / "designs").symlink_to(source / "designs")
        with mock.patch("builtins.print") as said:
            names = {}
            exec(compile(fast, "python.md", "exec"), names)
        self.assertEqual(names["evaluation"].status, "completed")
        self.assertEqual(said.call_args_list[0].args[0], 0.017)
        os.chdir(source)

    def test_every_example_is_named(self):
        text = (source / "docs/user/python.md").read_text(encoding="utf-8")
        listed = re.findall(r"^\| `(\w+\.py)` \|", text, re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(path.name for path in (source / "bindings/examples").glob("*.py")))

    def test_every_public_name_has_a_docstring(self):
        for name in perfora.__all__:
            value = getattr(perfora, name)
            if not callable(value):
                continue
            self.assertTrue(value.__doc__, name)
            if isinstance(value, type) and not issubclass(value, Exception):
                for member in vars(value):
                    if not member.startswith("_"):
                        self.assertTrue(getattr(value, member).__doc__, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
