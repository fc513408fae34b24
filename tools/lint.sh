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
  # The rules of .clang-tidy look at what is written: the files of a folder together, as the build compiles them, so that
  # headers are read once. The analyzer follows what may happen, in the file that it is given only: one at a time.
  analyzer=clang-analyzer-core*,clang-analyzer-cplusplus*,-clang-analyzer-cplusplus.NewDeleteLeaks
  for pass in "together ON " "alone OFF -*,$analyzer"; do
    read -r folder together checks <<<"$pass"
    cmake --preset release -B "build/lint/$folder" -DWORMDRIVE_TOGETHER="$together" >/dev/null
    # what the build generates and files include: the build itself would make the libraries first
    cmake --build "build/lint/$folder" --target wormdrive_commit >/dev/null
    touch "build/lint/$folder/generated/report_assets.cpp"
    # Not what the build itself generated. GCC's own options and pragmas mean nothing to clang, quadmath.h is GCC's own,
    # and to clang a name also shadows one of another file that is compiled with it.
    run-clang-tidy -quiet -p "build/lint/$folder" -checks="$checks" -extra-arg=-Wno-unused-command-line-argument \
      -extra-arg=-Wno-unknown-pragmas -extra-arg=-Wno-shadow \
      -extra-arg="-idirafter$(g++ -print-file-name=include)" "^$PWD/(?!build/.*/generated/)" |
      tee "build/lint/$folder/findings" || status=1
  done
  # paths through Eigen that no argument takes end in what the analyzer cannot know
  if sed $'s/\e\\[[0-9;]*m//g' build/lint/alone/findings | grep -q "^$PWD/.*\[clang-analyzer"; then status=1; fi
fi

if ((status == 0)); then echo "lint: ${#sources[@]} files, no findings"; fi
exit "$status"
