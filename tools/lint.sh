#!/usr/bin/env bash
# Style and static analysis, with the tools that are present (Debian: clang-format, clang-tidy; the rules are
# written for version 14). Takes an hour on two cores. Usage: tools/lint.sh [--help]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if (($# > 0)); then
  if [[ $# == 1 && ($1 == --help || $1 == -h) ]]; then
    sed -n '2,3s/^# //p' tools/lint.sh
    exit 0
  fi
  echo "lint: '$1' is no argument of it; --help tells what it does" >&2
  exit 2
fi

status=0
mapfile -d '' sources < <(find . \( -path ./build -o -path ./out -o -path ./.git \) -prune \
                               -o -type f -name '*.[ch]pp' -print0 | sort -z)

if ! command -v clang-format >/dev/null; then
  echo "lint: no clang-format, style not checked"
elif ((${#sources[@]})); then
  clang-format --dry-run -Werror "${sources[@]}" || status=1
fi

if ! command -v run-clang-tidy >/dev/null; then
  echo "lint: no clang-tidy, no static analysis"
else
  # every file by itself: compiled together they would stand in files of the build, which nobody reads
  cmake --preset release -B build/lint -DWORMDRIVE_TOGETHER=OFF >/dev/null
  cmake --build build/lint --target wormdrive_commit >/dev/null  # a header that a file includes
  # not what the build itself generated; GCC's own options mean nothing to clang, and quadmath.h is GCC's own
  run-clang-tidy -quiet -p build/lint -extra-arg=-Wno-unused-command-line-argument \
    -extra-arg="-idirafter$(g++ -print-file-name=include)" "^$PWD/(?!build/)" | tee build/lint/findings || status=1
  # paths through Eigen that no argument takes end in what the analyzer cannot know
  if sed $'s/\e\\[[0-9;]*m//g' build/lint/findings | grep -q "^$PWD/.*\[clang-analyzer"; then status=1; fi
fi

if ((status == 0)); then echo "lint: ${#sources[@]} files, no findings"; fi
exit "$status"
