#!/usr/bin/env bash
# Installs the Debian packages that wormdrive needs to build, run, plot and test; what is already there is left
# alone. With nothing missing it ends at once, without root and without network.
set -euo pipefail
export LC_ALL=C  # comm needs both of its lists sorted alike

packages=(
  g++                  # the C++20 compiler
  cmake                # configures the build from CMakePresets.json
  ninja-build          # runs it on all cores
  ccache               # makes the second build of a file free
  libsundials-dev      # CVODES: the reference solver and its root finding
  libeigen3-dev        # small linear algebra
  libhdf5-dev          # result files
  libceres-dev         # fits, and the Jet type that differentiates the equations
  libboost-dev         # interpolation, statistics, quasi-random numbers: headers only
  librandom123-dev     # random numbers without memory: headers only
  libcli11-dev         # command line
  libtomlplusplus-dev  # scenario files
  nlohmann-json3-dev   # reports for machines
  libfmt-dev           # text output
  libnlopt-dev         # searches for the worst case and the best experiment
  libopenmpi-dev       # sweeps shared by several machines
  openmpi-bin          # mpirun
  libarchive-dev       # writes FMUs, which are zip archives
  libcpp-httplib-dev   # wormdrive view: serves its page on the loopback address
  pkgconf              # tells how cpp-httplib was compiled
  libmatio-dev         # runs as MAT-files
  libjs-dygraphs       # reports: goes into the program when it is built
  catch2               # unit tests
  pybind11-dev         # the Python module
  python3-dev          # the Python module
  python3              # plots and tools/check_layers
  python3-numpy        # plots, the Python module
  python3-h5py         # plots: reads the result files
  python3-matplotlib   # plots: draws them
  libxml2-utils        # tests: FMUs against the schema of the standard
)  # git is not on the list: with it the commit is recorded in the results, without it they say so

if ! command -v apt-get >/dev/null; then
  echo "This is not a Debian-like system (no apt-get). Please install the equivalents of these packages:" >&2
  printf '  %s\n' "${packages[@]}" >&2
  exit 1
fi

# dpkg-query complains about packages it has never heard of: those are simply missing.
installed() {
  dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null | sed -n 's/^installed //p'
}
mapfile -t missing < <(comm -23 <(printf '%s\n' "${packages[@]}" | sort) <(installed | sort -u))
if ((${#missing[@]} == 0)); then exit 0; fi

as_root=(env DEBIAN_FRONTEND=noninteractive)
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "Please run as root: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo "${as_root[@]}")
fi

# --no-remove: rather stop than take away something the user has installed.
install() {
  "${as_root[@]}" apt-get install -y -q --no-install-recommends --no-remove "$@" "${missing[@]}"
}

echo "Installing ${#missing[@]} packages: ${missing[*]}"
if ! install --download-only 2>/dev/null; then  # the package lists are missing or out of date
  "${as_root[@]}" apt-get update -q
fi
install
