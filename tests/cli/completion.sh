#!/usr/bin/env bash
# Sources the completion in a bash and asks it as the Tab key does. Usage: completion.sh PROGRAM SCRIPT
set -euo pipefail
program=$1
source "$2"
cd "$(mktemp -d)"
trap 'rm -r "$PWD"' EXIT
touch my_arm.toml my_run.h5 notes.txt
mkdir my_folder
failures=0

# expect "words typed so far" "completions, sorted, separated by blanks"
expect() {
  read -ra COMP_WORDS <<<"$1"
  [[ $1 == *' ' ]] && COMP_WORDS+=("")
  COMP_WORDS[0]=$program
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _wormdrive
  local found
  found=$(printf '%s\n' "${COMPREPLY[@]}" | sort | xargs)
  [[ $found == "$2" ]] && return
  printf 'after "%s": expected "%s", found "%s"\n' "$1" "$2" "$found"
  failures=$((failures + 1))
}

expect "wormdrive st" "statics steady"
expect "wormdrive run --au" "--audit"
expect "wormdrive run --s" "--set"
expect "wormdrive run -" "--audit --force --help --json --output --quiet --set"
expect "wormdrive run my" "my_arm.toml my_folder my_run.h5"
expect "wormdrive run " "my_arm.toml my_folder my_run.h5"
expect "wormdrive plot --over m" "motor_torque"
expect "wormdrive list lo" "loads"
expect "wormdrive new --kind el" "elastic_teeth"
expect "wormdrive nonsense --" ""
[[ $(complete -p wormdrive) == *"-F _wormdrive wormdrive" ]] || failures=$((failures + 1))
echo "completion: $failures failures"
((failures == 0))
