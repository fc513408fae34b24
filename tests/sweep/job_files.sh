#!/usr/bin/env bash
# job_files.sh PROGRAM FILE...: job files are bash; the array makes shards that can be merged, also when its tasks are
# started twice; so do GNU parallel and, where mpirun is, the MPI job. What none of them has here is said to be skipped.
set -euo pipefail
program=$1
shift
for file; do bash -n "$file"; done
jobs=$(dirname "$1")
scenarios=$(dirname "$(dirname "$jobs")")

folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
PATH="$(dirname "$program"):$PATH"
sed -e 's/trials = 200/trials = 10/' -e "s|\.\./|$scenarios/|" "$scenarios/studies/fig10_sliding.toml" > study.toml
wormdrive sweep study.toml -o alone.h5 --quiet
wormdrive summary alone.h5 --json > alone.json
is_whole() { # RESULT: its answers are those of one process
  wormdrive summary "$1" --json | diff - alone.json
}

for task in 1 2 3 2; do
  SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_MAX=3 bash "$jobs/slurm_array.sh" study.toml array.h5
done
wormdrive merge shards/array_*_of_3.h5 -o array.h5 --quiet
is_whole array.h5

if command -v parallel > /dev/null; then
  bash "$jobs/gnu_parallel.sh" study.toml parallel.h5 3
  is_whole parallel.h5
else
  echo "skipped: GNU parallel is not installed"
fi

if command -v mpirun > /dev/null && [[ $(ldd "$program") == *libmpi* ]]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  bash "$jobs/slurm_mpi.sh" study.toml mpi.h5
  is_whole mpi.h5
else
  echo "skipped: no mpirun, or built without MPI"
fi
