#!/usr/bin/env bash
# Builds the release preset and runs every check. Arguments go to ctest: ./run_tests.sh -R mesh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

tools/install_packages.sh
cmake --preset release
cmake --build --preset release

tools/check_layers --self-test
tools/check_layers
ctest --preset release -j"$(nproc)" "$@"
