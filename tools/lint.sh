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
  # The files of a folder together, as the build compiles them, so that headers are read once. The analyzer follows paths
  # into a file that another one includes only where the name of that other one has "UnifiedSource" in it.
  build=build/lint/UnifiedSources
  cmake --preset release -B "$build" -DWORMDRIVE_TOGETHER=ON >/dev/null
  # what the build generates and files include: the build itself would make the libraries first
  cmake --build "$build" --target wormdrive_commit >/dev/null
  touch "$build/generated/report_assets.cpp"
  # Not what the build itself generated, and no file twice. GCC's own options and pragmas mean nothing to clang,
  # quadmath.h is GCC's own, and to clang a name also shadows one of another file that is compiled with it.
  analyzer=clang-analyzer-core*,clang-analyzer-cplusplus*,-clang-analyzer-cplusplus.NewDeleteLeaks
  run-clang-tidy -quiet -p "$build" -checks="$analyzer" -extra-arg=-Wno-unused-command-line-argument \
    -extra-arg=-Wno-unknown-pragmas -extra-arg=-Wno-shadow -extra-arg="-idirafter$(g++ -print-file-name=include)" \
    "^$PWD/(?!build/.*/(generated|wormdrive_fmu_asan.dir)/)" | tee "$build/findings" || status=1
  # paths through Eigen that no argument takes end in what the analyzer cannot know
  if sed $'s/\e\\[[0-9;]*m//g' "$build/findings" | grep "^$PWD/.*\[clang-analyzer" >/dev/null; then status=1; fi
fi

if ((status == 0)); then echo "lint: ${#sources[@]} files, no findings"; fi
exit "$status"
