#!/usr/bin/env bash
# A sweep as a Slurm array: task k of the array makes shard k of as many as the last argument says. What was lost or ran
# out of time is made by the same line again, or by one that names these tasks alone; the number of shards stays.
#
#   sbatch --array=1-100 slurm_array.sh study.toml sweep.h5 100
#   sbatch --array=7,13,42 slurm_array.sh study.toml sweep.h5 100
#   sbatch --dependency=afterok:JOB --ntasks=1 --wrap 'wormdrive merge shards/sweep_*_of_100.h5 -o sweep.h5'
#SBATCH --job-name=wormdrive
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
# A minute before the end wormdrive writes what it has and ends. B: says that the batch shell gets the signal, which
# steps of srun alone would get otherwise; exec makes wormdrive this shell.
#SBATCH --signal=B:TERM@60
set -euo pipefail

if [[ $# != 3 || -z ${SLURM_ARRAY_TASK_ID:-} ]]; then
  echo "usage: sbatch --array=1-SHARDS slurm_array.sh STUDY RESULT SHARDS" >&2
  exit 2
fi
study=$1 result=$2 shards=$3
name=$(basename "$result" .h5)
mkdir -p shards
exec wormdrive sweep "$study" --shard "$SLURM_ARRAY_TASK_ID/$shards" --threads "${SLURM_CPUS_PER_TASK:-1}" --resume \
  -o "shards/${name}_${SLURM_ARRAY_TASK_ID}_of_$shards.h5" --quiet
