#!/usr/bin/env bash
# A sweep on machines that share a folder and take ssh, by GNU parallel; without a list of machines, on this one. The
# same line again makes what is missing.
#
#   ./gnu_parallel.sh study.toml sweep.h5 40                # 40 shards here, as many at a time as there are cores
#   ./gnu_parallel.sh study.toml sweep.h5 40 machines.txt   # one machine per line
set -euo pipefail

study=$1 result=$2 shards=$3 machines=${4:-}
name=$(basename "$result" .h5)
mkdir -p shards
remote=()
if [[ -n $machines ]]; then remote=(--sshloginfile "$machines" --workdir "$PWD"); fi
seq "$shards" | parallel "${remote[@]}" --retries 3 --line-buffer \
  wormdrive sweep "$study" --shard "{}/$shards" --threads 1 --resume -o "shards/${name}_{}_of_$shards.h5" --quiet
wormdrive merge shards/"$name"_*_of_"$shards".h5 -o "$result"
