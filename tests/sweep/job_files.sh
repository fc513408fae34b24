#!/usr/bin/env bash
# job_files.sh PROGRAM FILE...: job files are bash, and the array makes shards that can be merged, also when its tasks
# are started twice.
set -euo pipefail
program=$1
shift
for file; do bash -n "$file"; done

folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
PATH="$(dirname "$program"):$PATH"
scenarios=$(dirname "$(dirname "$(dirname "$1")")")
sed -e 's/trials = 200/trials = 10/' -e "s|\.\./|$scenarios/|" "$scenarios/studies/fig10_sliding.toml" > study.toml
for task in 1 2 3 2; do
  SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_MAX=3 bash "$scenarios/studies/jobs/slurm_array.sh" study.toml sweep.h5
done
wormdrive merge shards/sweep_*_of_3.h5 -o sweep.h5 --quiet
test -s sweep.h5
