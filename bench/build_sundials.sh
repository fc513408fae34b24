#!/usr/bin/env bash
# Debian compiles SUNDIALS without optimisation. This builds the same version from Debian's own source package with
# -O3, so that the benchmarks can be run against both. Needs what tools/install_packages.sh installs, and no root.
#
#   bench/build_sundials.sh [folder]    default: build/sundials; pass it to cmake as -DWORMDRIVE_BENCH_SUNDIALS_DIR=...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=$(realpath -m "${1:-build/sundials}")

version=$(dpkg-query -W -f='${source:Version}' libsundials-dev)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{parts,lists/partial,archives/partial}

# The machine's own package sources, asked for sources instead of programs; both formats that apt knows.
shopt -s nullglob
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
  if [[ -f $list ]]; then sed -n 's/^deb /deb-src /p' "$list" >"$work/parts/${list##*/}"; fi
done
for list in /etc/apt/sources.list.d/*.sources; do
  sed 's/^Types:.*/Types: deb-src/' "$list" >"$work/parts/${list##*/}"
done
own=(-o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/parts" -o Dir::State::Lists="$work/lists"
     -o Dir::Cache="$work" -o Dir::Cache::Archives="$work/archives" -o APT::Sandbox::User="$(id -un)")

echo "fetching the source of SUNDIALS $version"
apt-get "${own[@]}" -q update >/dev/null
(cd "$work" && apt-get "${own[@]}" -q source --download-only "sundials=$version" >/dev/null)
mkdir "$work/source"
tar -xf "$work"/sundials_*.orig.tar.* -C "$work/source" --strip-components=1

echo "building CVODES and ARKODE with -O3"
cmake -S "$work/source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE="-O3 -DNDEBUG" \
      -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=OFF -DBUILD_STATIC_LIBS=ON \
      -DBUILD_CVODES=ON -DBUILD_ARKODE=ON -DBUILD_CVODE=OFF -DBUILD_IDA=OFF -DBUILD_IDAS=OFF -DBUILD_KINSOL=OFF \
      -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_ENABLE_CXX=OFF -DEXAMPLES_INSTALL=OFF >"$work/log" 2>&1 ||
  { cat "$work/log" >&2; exit 1; }
cmake --build "$work/build" --target install >>"$work/log" 2>&1 || { tail -n 40 "$work/log" >&2; exit 1; }
echo "installed in $folder"
