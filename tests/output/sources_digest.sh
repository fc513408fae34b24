#!/usr/bin/env bash
# sources_digest.sh CMAKE SOURCE PROGRAM: trees without git and changed trees of one commit have digests of their own,
# what decides no result changes none, and the program tells the one of its sources.
set -euo pipefail
cmake=$1 source=$2 program=$3

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
tree=$folder/tree
mkdir "$tree"
for part in CMakeLists.txt README.md core events statistics control description output simulation scenarios sweep diagnosis \
  cli docs; do
  cp -r "$source/$part" "$tree/$part"
done

write_header() { "$cmake" -DSOURCE="$tree" -DOUTPUT="$folder/commit.hpp" -DVERSION=0.1.0 -P "$source/tools/commit.cmake"; }
value() { # NAME: of the header
  sed -n "s/.* $1 = \"\(.*\)\";/\1/p" "$folder/commit.hpp"
}
fail() { echo "$1" >&2 && exit 1; }

write_header
[[ $(value commit) == unknown ]] || fail "a tree without git has commit $(value commit)"
as_it_is=$(value sources)
[[ $as_it_is =~ ^[0-9a-f]{12}$ ]] || fail "'$as_it_is' is no digest"
[[ $("$program" --version) == "wormdrive 0.1.0 (sources $as_it_is, commit "*")" ]] \
  || fail "$("$program" --version) is not of sources $as_it_is"

touch -d "2001-01-01" "$folder/commit.hpp"
echo "a word more" >> "$tree/README.md"
echo "a word more" >> "$tree/docs/model.md"
echo "// a word more" >> "$tree/cli/main.cpp"
write_header
[[ $(stat -c %Y "$folder/commit.hpp") == $(date -d "2001-01-01" +%s) ]] || fail "a page that changes makes a build"

seen=" $as_it_is "
is_new() { # WHAT
  write_header
  [[ $seen != *" $(value sources) "* ]] || fail "$1: the digest stays $(value sources)"
  seen+="$(value sources) "
}
for file in core/mesh.hpp events/simulation_failure.hpp statistics/parallel.cpp control/pid.cpp description/keys.cpp \
  output/hdf5/table.cpp simulation/replay.hpp sweep/study/design.cpp diagnosis/verdict/certificate.cpp CMakeLists.txt; do
  echo >> "$tree/$file"
  is_new "$file changes"
done
mv "$tree/sweep/study/design.cpp" "$tree/sweep/study/drawing.cpp"
is_new "a file has another name"
rm "$tree/core/mesh.hpp"
is_new "a file is missing"

if ! command -v git > /dev/null; then
  echo "skipped: two changed trees of one commit, for git is not installed"
  exit
fi
git -C "$tree" init -q
git -C "$tree" add .
git -C "$tree" -c user.name=nobody -c user.email=nobody@localhost commit -q -m "a tree"
for change in "// one" "// another"; do
  echo "$change" >> "$tree/sweep/trial.cpp"
  is_new "$change"
  [[ $(value commit) == *-dirty ]] || fail "a changed tree has commit $(value commit)"
  git -C "$tree" checkout -q sweep/trial.cpp
done
