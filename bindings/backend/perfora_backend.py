# What is here: the backend (PEP 517) by which `pip install .` makes a wheel: CMake builds the module in build/release,
# where `./run build` builds, too, so that nothing is compiled twice. What is not: what is built (bindings/CMakeLists.txt).
"""Builds a wheel of the Python module from a checkout, with CMake and nothing from the network.

The build folder is build/release, or what `--config-settings build-dir=DIR` or PERFORA_BUILD_DIR says.
"""
import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

root = Path(__file__).resolve().parents[2]


def version():
    text = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(Perfora VERSION ([0-9.]+)", text).group(1)


def metadata():
    return (
        "Metadata-Version: 2.1\n"
        "Name: perfora\n"
        f"Version: {version()}\n"
        "Summary: Designs perforated concrete blocks that crush at a wanted stress\n"
        "License: GPL-3.0-or-later\n"
        "Requires-Python: >=3.9\n"
        "Requires-Dist: numpy\n"
    )


def wheel_file():
    tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    text = f"Wheel-Version: 1.0\nGenerator: perfora_backend\nRoot-Is-Purelib: false\nTag: {tag}-{tag}-{platform}\n"
    return f"{tag}-{tag}-{platform}", text


def jobs():
    """Compilers of this project take about 1.5 GB each: never more of them than memory holds."""
    cores = len(os.sched_getaffinity(0))
    found = re.search(r"MemAvailable: +(\d+)", Path("/proc/meminfo").read_text(encoding="ascii"))
    return max(1, min(cores, int(found.group(1)) // 2_000_000 if found else 2))


def cached(folder, name):
    cache = folder / "CMakeCache.txt"
    text = cache.read_text(encoding="utf-8") if cache.exists() else ""
    found = re.search(rf"^{name}:[A-Z]+=(.*)$", text, re.MULTILINE)
    return found.group(1) if found else None


def suffix_of(python):
    code = "import sysconfig; print(sysconfig.get_config_var('EXT_SUFFIX'))"
    return subprocess.run([python, "-c", code], check=True, capture_output=True, text=True).stdout.strip()


def run(*command):
    print("+", *command, flush=True)
    if subprocess.run(command, cwd=root, check=False).returncode:
        raise SystemExit(f"perfora: failed: {' '.join(command)}; ./setup.sh installs what the build needs")


def configured(config_settings):
    """A build folder whose module fits the Python that asks, configured."""
    asked = (config_settings or {}).get("build-dir") or os.environ.get("PERFORA_BUILD_DIR")
    folder = Path(asked).resolve() if asked else root / "build/release"
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    python = getattr(sys, "_base_executable", sys.executable)  # a virtual environment may be gone tomorrow
    known = cached(folder, "PERFORA_PYTHON")
    if known and suffix_of(known) != suffix and not asked:
        folder = root / f"build/python-{sys.implementation.cache_tag}"
        known = cached(folder, "PERFORA_PYTHON")
    if not known:
        run("cmake", "--preset", "release", "-B", str(folder), f"-DPERFORA_PYTHON={python}")
    module = folder / f"python/perfora/_core{suffix}"
    return folder, module


def built(config_settings):
    folder, module = configured(config_settings)
    run("cmake", "--build", str(folder), "--parallel", str(jobs()), "--target", "python_module")
    if not module.exists():
        raise SystemExit(f"perfora: {folder} builds its module for another Python; give another build-dir")
    return module


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    module = built(config_settings)
    tag, wheel = wheel_file()
    info = f"perfora-{version()}.dist-info"
    package = [module] + [module.parent / name for name in ("__init__.py", "_functions.py", "_core.pyi", "py.typed")]
    entries = [(f"perfora/{path.name}", path.read_bytes()) for path in package]
    entries += [
        (f"{info}/METADATA", metadata().encode()),
        (f"{info}/WHEEL", wheel.encode()),
        (f"{info}/LICENSE", (root / "LICENSE").read_bytes()),
    ]
    name = f"perfora-{version()}-{tag}.whl"
    record = ""
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in entries:
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{path},sha256={digest},{len(content)}\n"
            archive.writestr(path, content)
        archive.writestr(f"{info}/RECORD", record + f"{info}/RECORD,,\n")
    return name


class UnsupportedOperation(Exception):
    pass


def build_sdist(sdist_directory, config_settings=None):
    raise UnsupportedOperation("the source of Perfora is its repository")
