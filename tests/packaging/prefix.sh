#!/usr/bin/env bash
# Installs into a prefix, moves the prefix, and uses what is there: program, pages of the manual, Python module and the
# package for CMake, from which the example is built. Usage: prefix.sh CMAKE BUILD PYTHON...
set -euo pipefail
cmake=$1 build=$2 python=("${@:3}")
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
trap 'echo "prefix: line $LINENO: $BASH_COMMAND" >&2' ERR
cd "$folder"

expect() {  # "what was printed" "what has to stand in it"
  [[ $1 == *"$2"* ]] && return
  printf 'prefix: expected "%s" in:\n%s\n' "$2" "$1" >&2
  return 1
}

"$cmake" --install "$build" --prefix "$folder/first" >/dev/null
mv first moved
prefix=$folder/moved
program=$prefix/bin/wormdrive

# the program finds what belongs to it, beside itself and through a link
ln -s "$program" linked
expect "$(./linked list scenarios)" "scenarios in $prefix/share/wormdrive/scenarios"
scenario=$prefix/share/wormdrive/scenarios/fig09_switching.toml
"$program" run "$scenario" --set run.duration_s=0.3 -q -o run.h5
"$program" fmu "$scenario" -o drive.fmu >/dev/null
if "${python[@]}" -c "import h5py, matplotlib" 2>/dev/null; then
  "$program" plot run.h5 >/dev/null
  [[ -s run.png ]]
fi
# and says where it looked
mkdir -p alone/bin
cp "$program" alone/bin
status=0
error=$(alone/bin/wormdrive list scenarios 2>&1) || status=$?
((status == 4))
expect "$error" "wormdrive: cannot find share/wormdrive/scenarios in $folder/alone/bin or in $folder/alone; install wormdrive again"

# a page of the manual for the program and for each command, with every option of its help
for command in "" $("$program" --help | sed -n 's/^  \([a-z][a-z]*\)  .*/\1/p'); do
  page=$(gzip -dc "$prefix/share/man/man1/wormdrive${command:+-$command}.1.gz" | sed 's/\\-/-/g')
  expect "$page" ".SH NAME"
  for option in $("$program" $command --help | sed -n 's/^  \(-[a-zA-Z],\)\{0,1\}\(--[a-z-]*\).*/\2/p'); do
    expect "$page" "$option\\fR"
  done
done

module=$(find "$prefix" -path '*-packages/wormdrive' -type d)
if [[ -n $module ]]; then
  expect "$(PYTHONPATH=${module%/*} "${python[@]}" -B -c "import wormdrive; print(wormdrive.__file__)")" "$module"
fi

# a program of one's own, without the optimisation that the libraries have had
"$cmake" -G Ninja -S "$prefix/share/doc/wormdrive/example" -B example -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS_DEBUG=-O0 >configured 2>&1 || { cat configured >&2; exit 1; }
"$cmake" --build example >built 2>&1 || { cat built >&2; exit 1; }
expect "$(example/my_simulator "$scenario")" "12 events; at the end the gear is at "

# nothing that is installed as text knows where it was built or installed first
if found=$(grep -rIlF -e "$build" -e "$folder/first" "$prefix"); then
  echo "prefix: these name a folder of the build: $found" >&2
  exit 1
fi
echo "prefix: all found after a move"
