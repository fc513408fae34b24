#!/usr/bin/env bash
# job_files.sh PROGRAM FILE...: job files are bash; the array makes shards that can be merged, also when some of its tasks
# are submitted again; a minute before their time is over Slurm's jobs end with all that they have; GNU parallel and,
# where mpirun is, the MPI job make the rows of one process. What none of them has here is said to be skipped.
set -euo pipefail
program=$(realpath "$1")
shift
for file; do bash -n "$file"; done
jobs=$(dirname "$1")
tests=$(dirname "$0")
scenarios=$(dirname "$(dirname "$jobs")")

folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
PATH="$(dirname "$program"):$PATH"
fail() { echo "$1" >&2 && exit 1; }

# Slurm as far as a batch script sees it: a single process in an allocation of many.
be_task() { # ID MAX: of an array whose greatest task is MAX
  export SLURM_JOB_ID=1 SLURM_NTASKS=128 SLURM_PROCID=0 SLURM_ARRAY_TASK_ID=$1 SLURM_ARRAY_TASK_MAX=$2
}
as_task() { (be_task "$1" "$2" && "${@:3}"); } # ID MAX COMMAND...
steps=$folder/steps # who runs as a step: nobody but what srun starts
mkdir -p bin
printf '#!/bin/bash\necho $$ >> %s\nexec "${@}"\n' "$steps" > bin/srun
chmod +x bin/srun
PATH="$folder/bin:$PATH"
# Runs a job whose time is over once there are trials. Before, its signal goes where --signal says: with B: to the batch
# shell alone, without to the steps alone. Then everything is killed. The exit code, and what it said to job.err.
until_time_is_over() { # PART SCRIPT ARGUMENT...
  local part=$1 script=$2 signal pid rc=0
  signal=$(sed -n 's/^#SBATCH --signal=\([^ ]*\)@.*/\1/p' "$script")
  : > "$steps"
  (be_task 1 3 && exec setsid bash "${@:2}" > job.out 2> job.err) &
  pid=$!
  for ((k = 0; k < 600; ++k)); do
    wormdrive summary "$part" > so_far.out 2> /dev/null && grep -q "[1-9][0-9]* of .* so far" so_far.out && break
    sleep 0.1
  done
  case $signal in
    B:*) kill -"${signal#B:}" "$pid" ;;
    *) while read -r step; do kill -"$signal" "$step"; done < "$steps" ;;
  esac
  for ((k = 0; k < 300; ++k)); do
    kill -0 "$pid" 2> /dev/null || break
    sleep 0.1
  done
  kill -KILL -- "-$pid" 2> /dev/null || true
  wait "$pid" || rc=$?
  return "$rc"
}

study() { # TRIALS
  sed -e "s/trials = 200/trials = $1/" -e "s|\.\./|$scenarios/|" "$scenarios/studies/fig10_sliding.toml"
}
study 10 > study.toml
study 90000 > long.toml # many minutes
wormdrive sweep study.toml -o alone.h5 --quiet
wormdrive summary alone.h5 --json > alone.json
is_whole() { # RESULT: its answers are those of one process
  wormdrive summary "$1" --json | diff - alone.json
}

for task in 1 3 3; do as_task $task 3 bash "$jobs/slurm_array.sh" study.toml array.h5 3; done
as_task 2 2 bash "$jobs/slurm_array.sh" study.toml array.h5 3 # sbatch --array=2: what was lost, alone
wormdrive merge shards/array_*_of_3.h5 -o array.h5 --quiet
is_whole array.h5
as_task 1 3 bash "$jobs/slurm_array.sh" study.toml array.h5 2> usage.err && fail "a number of shards was made up"
grep -q "^usage: sbatch --array=1-SHARDS slurm_array.sh STUDY RESULT SHARDS$" usage.err || fail "$(cat usage.err)"

rc=0
until_time_is_over shards/long_1_of_3.h5 "$jobs/slurm_array.sh" long.toml long.h5 3 || rc=$?
[[ $rc == 143 ]] || fail "the array's task ended with $rc: $(cat job.err)"
grep -q "^wormdrive: interrupted after [1-9][0-9]* of 30000 trials, which are in shards/long_1_of_3.h5.part;" job.err \
  || fail "$(cat job.err)"

if command -v parallel > /dev/null; then
  bash "$jobs/gnu_parallel.sh" study.toml parallel.h5 3
  is_whole parallel.h5
else
  echo "skipped: GNU parallel is not installed"
fi

if command -v mpirun > /dev/null && [[ $(ldd "$program") == *libmpi* ]]; then
  set -a
  source "$tests/mpirun.env"
  set +a
  bash "$jobs/slurm_mpi.sh" study.toml mpi.h5
  is_whole mpi.h5
  rc=0
  until_time_is_over ranks.h5 "$jobs/slurm_mpi.sh" long.toml ranks.h5 || rc=$?
  grep -q "^wormdrive: stopped after [1-9][0-9]* of 90000 trials, which are in ranks.h5.rank_\*;" job.err \
    || fail "the ranks ended with $rc: $(cat job.err)"
else
  echo "skipped: no mpirun, or built without MPI"
fi
