#!/usr/bin/env bash
# What is here: installs the Debian 12 packages Perfora is built from, those that are missing only; asks nothing.
# What is not: building and running (see ./run).
#
#   ./setup.sh             compiler and libraries
#   ./setup.sh --viewers   also the programs that some tests need: ParaView, LAMMPS, ase, ezdxf for exports, Chromium for
#                          reports, doxygen, MPI, what tests and examples in Python use (about 800 MB; used by .ci/run)
#   ./setup.sh --list      prints the package names, installs nothing
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config              # build
  libcgal-dev libeigen3-dev libboost-dev libnlopt-cxx-dev  # geometry, linear algebra, models, search
  libhdf5-dev zlib1g-dev libtomlplusplus-dev libpugixml-dev libcli11-dev libspdlog-dev nlohmann-json3-dev  # files, command line, log
  librandom123-dev libcairo2-dev fonts-dejavu-core  # random streams, pictures
  libjs-chart.js node-pako                      # charts and decompression in reports, put into the program
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev    # tests, benchmarks
  python3-dev pybind11-dev python3-numpy python3-venv  # the Python module, pip install
)
viewer_packages=(
  python3-paraview python3-h5py doxygen
  lammps python3-ase python3-ezdxf python3-pil xvfb xauth  # exports
  chromium chromium-driver python3-selenium  # reports
  libopenmpi-dev openmpi-bin  # perfora-mpi and its tests
  mypy python3-scipy python3-matplotlib python3-optuna python3-dask  # tests and examples of the Python module
)

with_viewers=no
list_only=no
for argument in "$@"; do
  case "$argument" in
    --viewers) with_viewers=yes ;;
    --list) list_only=yes ;;
    *) echo "setup.sh: unknown argument '$argument'; allowed: --viewers, --list" >&2; exit 1 ;;
  esac
done
[ "$with_viewers" = yes ] && packages+=("${viewer_packages[@]}")
if [ "$list_only" = yes ]; then printf '%s\n' "${packages[@]}"; exit 0; fi

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
  echo "setup.sh: this system has no apt; install the counterparts of these packages yourself: ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#packages[@]} packages are there"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null; then
    echo "setup.sh: packages are missing and there is no sudo; run as root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
  [ -t 0 ] || as_root=(sudo -n)
fi
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive NEEDRESTART_MODE=a apt-get -q -y \
    -o DPkg::Lock::Timeout=300 -o Dpkg::Options::=--force-confold -o Acquire::Retries=3 "$@" < /dev/null
}
echo "setup: installing ${missing[*]}"
# An old package list is the usual reason for a failed install, so the list is renewed first; where that fails, the one that is there may do.
apt update || echo "setup: the package list could not be renewed; going on with the one that is there" >&2
apt install --no-install-recommends "${missing[@]}"
