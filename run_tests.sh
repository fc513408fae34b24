#!/usr/bin/env bash
# Builds the release preset and runs every check. Arguments go to ctest: ./run_tests.sh -R mesh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

tools/install_packages.sh
cmake --preset release
cmake --build --preset release -j"$(nproc)"  # not more: a compiler takes up to 2.5 GB

tools/check_layers --self-test
tools/check_layers
# one more than processors: some tests wait for a browser, for a signal or for other ranks
ctest --preset release -j"$(($(nproc) + 1))" "$@"
