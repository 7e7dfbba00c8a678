# What is here: `pip install .` of the checkout in a fresh virtual environment, without network, and the module that is
# installed. What is not: compiling; the build folder of the tests has the module.
import importlib.util
import os
import subprocess
import sys
import unittest

from support import FolderTest, run, skipped, source

if importlib.util.find_spec("ensurepip") is None:
    print("skipped: python3-venv is not installed")
    sys.exit(skipped)


class InstallTest(FolderTest):
    def test_pip_installs_the_module_without_network(self):
        environment = self.folder / "environment"
        run(sys.executable, "-m", "venv", "--system-site-packages", environment)
        python = environment / "bin/python"
        # PERFORA_BUILD_DIR names the build folder. No index at all: whatever pip wanted from one would fail.
        run(python, "-m", "pip", "install", "--no-index", "--disable-pip-version-check", source)
        code = (
            "import perfora, pathlib, importlib.metadata as m;"
            "print(pathlib.Path(perfora.__file__).parent, perfora.__version__, m.version('perfora'));"
            "print(perfora.Design()['layout.rows'])"
        )
        clean = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        said = subprocess.run(
            [python, "-c", code], cwd=self.folder, env=clean, capture_output=True, text=True, check=True
        ).stdout.split()
        self.assertTrue(said[0].startswith(str(environment)), said[0])
        self.assertEqual(said[1], said[2])
        self.assertEqual(said[3], "6")
        folder = environment / "lib" / f"python3.{sys.version_info[1]}" / "site-packages/perfora"
        self.assertTrue({"py.typed", "_core.pyi"} <= set(os.listdir(folder)))
        run(python, "-m", "pip", "uninstall", "-y", "perfora")
        self.assertFalse(folder.exists())


if __name__ == "__main__":
    unittest.main()
