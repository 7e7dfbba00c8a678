# What is here: designs in Python: mappings, files, values of every type, errors. What is not: what keys do (tests/io,
# tests/optimize).
import copy
import pickle
import unittest

import numpy as np
import perfora

from support import FolderTest, small, source


class DesignTest(FolderTest):
    def test_mapping_flat_mapping_and_file_are_one_design(self):
        nested = perfora.Design(small)
        flat = perfora.Design({f"{section}.{key}": value for section, keys in small.items() for key, value in keys.items()})
        self.assertEqual(nested, flat)
        file = self.folder / "d.toml"
        file.write_text(nested.to_toml())
        self.assertEqual(perfora.Design(file), nested)
        self.assertEqual(perfora.Design(str(file)), nested)
        self.assertEqual(perfora.Design(dict(nested)), nested)

    def test_values_have_the_types_of_their_keys(self):
        design = perfora.Design(small)
        self.assertEqual(design["cell.width"], 0.012)
        self.assertEqual(design["layout.rows"], 1)
        self.assertIsInstance(design["layout.rows"], int)
        self.assertEqual(design["layout.family"], "square")
        for key in perfora.keys():
            kinds = {"real": float, "integer": int, "boolean": bool, "real list": list, "real rows": list}
            self.assertIsInstance(design[key.name], kinds.get(key.type, str), key.name)
            self.assertIn(key.name, design)
        self.assertEqual(len(design), len(list(design)))

    def test_lists_rows_and_words_read_back(self):
        design = perfora.Design(small)
        design["layout.family"] = "list"
        design["layout.holes"] = [[0.003, 0.003, 0.002], [0.009, 0.009, 0.002]]
        self.assertEqual(design["layout.holes"], [[0.003, 0.003, 0.002], [0.009, 0.009, 0.002]])
        design["target.window"] = "found"
        self.assertEqual(design["target.window"], "found")
        design["target.window"] = [0.1, 0.2]
        self.assertEqual(design["target.window"], [0.1, 0.2])
        self.assertEqual(dict(design)["layout.holes"][1][0], 0.009)

    def test_every_way_to_write_a_number_is_that_number(self):
        design = perfora.Design(small)
        for value in ("7 mm", 0.007, np.float64(0.007), "0.7cm"):
            design["layout.diameter"] = value
            self.assertEqual(design["layout.diameter"], 0.007)
        third = 1.0 / 3.0
        design["layout.diameter"] = third / 100.0
        self.assertEqual(design["layout.diameter"], third / 100.0)
        design["layout.rows"] = np.int64(2)
        self.assertEqual(design["layout.rows"], 2)
        design.set({"layout": {"family": "rows", "row_diameter": np.array([0.004, 0.005])}})
        self.assertEqual(design["layout.row_diameter"], [0.004, 0.005])
        design["layout.row_diameter[1]"] = "6 mm"
        self.assertEqual(design["layout.row_diameter"], [0.004, 0.006])
        self.assertEqual(design["layout.row_diameter[1]"], 0.006)
        design["layout.row_diameter"] = ["3 mm", "4 mm"]
        self.assertEqual(design["layout.row_diameter"], [0.003, 0.004])

    def test_changes_make_a_copy_or_change_all_or_nothing(self):
        design = perfora.Design(small)
        other = design.with_changes({"layout.diameter": "5 mm"})
        self.assertEqual((design["layout.diameter"], other["layout.diameter"]), (0.006, 0.005))
        with self.assertRaises(perfora.InputError):
            design.set({"layout.diameter": "5 mm", "layout.rows": -1})
        self.assertEqual(design["layout.diameter"], 0.006)
        self.assertEqual(perfora.Design(small, {"layout": {"diameter": "5 mm"}}), other)

    def test_copies_and_pickles_are_equal_and_apart(self):
        design = perfora.Design(small)
        for copied in (copy.copy(design), copy.deepcopy(design), pickle.loads(pickle.dumps(design)), perfora.Design(design)):
            self.assertEqual(copied, design)
            copied["layout.diameter"] = "5 mm"
            self.assertNotEqual(copied, design)

    def test_wrong_input_is_a_value_error_that_says_what_to_do(self):
        with self.assertRaisesRegex(perfora.InputError, "did you mean layout.diameter"):
            perfora.Design({"layout.diametre": 1})
        with self.assertRaisesRegex(ValueError, "^layout.diameter: .*out of range"):
            perfora.Design(small)["layout.diameter"] = "-3 mm"
        with self.assertRaisesRegex(perfora.InputError, "did you mean layout.diameter"):
            perfora.Design(small)["layout.diametre"]
        with self.assertRaisesRegex(perfora.InputError, "cell.width: takes no object"):
            perfora.Design({"cell.width": object()})
        with self.assertRaisesRegex(perfora.InputError, "none.toml"):
            perfora.Design(self.folder / "none.toml")
        with self.assertRaises(TypeError):
            perfora.Design(3)
        with self.assertRaises(perfora.InputError):
            perfora.Design(small, {"layout.diameter": "14 mm"}).check()  # holes overlap

    def test_designs_of_the_repository_are_read(self):
        files = [file for file in (source / "designs").glob("*.toml") if perfora.kind_of(file) == "design"]
        self.assertGreater(len(files), 3)
        for file in files:
            design = perfora.read(file)
            self.assertEqual(perfora.Design.from_toml(design.to_toml()), design)


if __name__ == "__main__":
    unittest.main()
