# What is here: result files read in Python, held against h5py and the CSV beside them. What is not: their formats
# (tests/results).
import gc
import shutil
import sys
import unittest

import numpy as np
import perfora

from support import FolderTest, needs, program, run, small, source

needs("h5py")
import h5py  # noqa: E402


class FilesTest(FolderTest):
    def test_run_is_what_h5py_reads(self):
        file = self.folder / "r.h5"
        made = perfora.evaluate(perfora.Design(small, {"loading.until": 0.03}), run_file=file)
        read = perfora.read(file)
        self.assertIsInstance(read, perfora.Run)
        np.testing.assert_array_equal(read.evaluation.stress, made.stress)
        self.assertEqual(read.evaluation.record, made.record)
        self.assertEqual(read.design, perfora.Design(small, {"loading.until": 0.03}))
        copied = shutil.copy(file, self.folder / "copy.h5")  # HDF5 opens no file twice with other locking
        with h5py.File(copied) as stored:
            self.assertEqual(len(read.frame_strains), len(stored["frames"]))
            last = stored["frames"][sorted(stored["frames"])[-1]]
            frame = read.frame(-1)
            self.assertEqual(frame.strain, last.attrs["strain"])
            np.testing.assert_array_equal(frame.position, last["discs/position"])
            np.testing.assert_array_equal(frame.fragment, last["discs/fragment"])
            np.testing.assert_array_equal(frame.damage, last["discs/damage"])
            np.testing.assert_array_equal(frame.bonds, last["bonds/pairs"])
            np.testing.assert_array_equal(frame.bond_damage, last["bonds/damage"])
            self.assertGreater(stored["events/time"].size, 0)
            for name in ("time", "strain", "bond", "x", "energy"):
                np.testing.assert_array_equal(read.events[name], stored["events"][name])
            np.testing.assert_array_equal(read.bonds.discs, stored["bonds/pairs"])
            np.testing.assert_array_equal(read.bonds.reference_length, stored["bonds/rest_length"])
        self.assertFalse(frame.position.flags.writeable)
        position, discs = read.frame(0).position, perfora.read(file).discs.x
        gc.collect()
        self.assertEqual(position.shape, (len(discs), 2))
        np.testing.assert_allclose(position[:, 0], discs, atol=1e-15)
        with self.assertRaises(IndexError):
            read.frame(len(read.frame_strains))

    def test_frames_with_velocities_and_forces(self):
        file = self.folder / "r.h5"
        perfora.evaluate(perfora.Design(small, {"loading.until": 0.01, "output.frame_data": "all"}), run_file=file)
        frame = perfora.read(file).frame(-1)
        copied = shutil.copy(file, self.folder / "copy.h5")
        with h5py.File(copied) as stored:
            last = stored["frames"][sorted(stored["frames"])[-1]]
            for name, place in (("velocity", "discs/velocity"), ("spin", "discs/spin"), ("stress", "discs/stress"),
                                ("bond_normal_force", "bonds/normal_force"), ("bond_shear_force", "bonds/shear_force"),
                                ("contacts", "contacts/pairs"), ("contact_normal_force", "contacts/normal_force"),
                                ("contact_shear_force", "contacts/shear_force")):
                np.testing.assert_array_equal(getattr(frame, name), last[place], err_msg=name)

    def test_elastic_response(self):
        design, file = self.folder / "d.toml", self.folder / "e.h5"
        design.write_text(perfora.Design(small).to_toml())
        run(program, "evaluate", design, "--elastic", "-o", file, "--quiet")
        elastic = perfora.read(file)
        self.assertEqual(elastic.stiffness.shape, (3, 3))
        np.testing.assert_allclose(elastic.stiffness, elastic.stiffness.T, rtol=1e-3, atol=1e-3 * elastic.stiffness[0, 0])
        # Relaxation makes it softer, never stiffer.
        self.assertTrue(np.all(np.linalg.eigvalsh(elastic.affine_stiffness - elastic.stiffness) > 0.0))
        self.assertEqual(elastic.displacement[1].shape, (len(elastic.discs), 3))
        self.assertEqual(elastic.design, perfora.Design(small))
        self.assertEqual(elastic.record["status"], "completed")
        strains = elastic.first_bonds["strain"]
        self.assertTrue(np.all(np.diff(strains) >= 0.0))
        self.assertEqual(np.min(elastic.disc_strain), strains[0])

    def test_material_tests(self):
        design, file = self.folder / "d.toml", self.folder / "t.h5"
        tests = {"size": "8 mm", "compression": False, "shear": False, "oedometric": False}
        design.write_text(perfora.Design(small, {"material_test": tests}).to_toml())
        run(program, "test", design, "-o", file, "--quiet")
        tests = perfora.read(file)
        self.assertEqual([test.name for test in tests.tests], ["tension"])
        (test,) = tests.tests
        self.assertEqual(test.curve.unit("stress"), "Pa")
        self.assertGreater(test.curve["stress"].max(), 0.0)
        self.assertGreater(len(tests.sample), 10)

    def test_tables_kinds_and_refusals(self):
        table = perfora.read(source / "docs/data/table1-to-60-percent.csv")
        rows = np.genfromtxt(source / "docs/data/table1-to-60-percent.csv", delimiter=",", names=True)
        self.assertEqual(list(table), list(rows.dtype.names))
        np.testing.assert_array_equal(dict(table)["stress_yy"], rows["stress_yy"])
        self.assertEqual((table.rows, table.unit("stress_yy")), (len(rows), "Pa"))
        self.assertEqual(table.texts("strain_yy")[1], "0.0005")
        self.assertEqual(perfora.kind_of(source / "designs/study-quick.toml"), "study file")
        with self.assertRaisesRegex(perfora.InputError, "is a study file"):
            perfora.read(source / "designs/study-quick.toml")
        with self.assertRaisesRegex(perfora.InputError, "nothing that the program wrote"):
            perfora.read(source / "LICENSE")
        with self.assertRaisesRegex(perfora.InputError, "no such file"):
            perfora.read(self.folder / "none")
        self.assertIsNone(perfora.stored_record(source / "LICENSE"))


if __name__ == "__main__":
    sys.exit(unittest.main())
