#!/usr/bin/env bash
# A sweep as a Slurm array: every task makes one shard; the same line again makes what was lost or ran out of time.
#
#   sbatch --array=1-100 slurm_array.sh study.toml sweep.h5
#   sbatch --dependency=afterok:JOB --ntasks=1 --wrap 'wormdrive merge shards/sweep_*_of_100.h5 -o sweep.h5'
#SBATCH --job-name=wormdrive
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --signal=TERM@60  # a minute before the end: wormdrive writes what it has and ends
set -euo pipefail

study=$1 result=$2
shards=${SLURM_ARRAY_TASK_MAX:?start it with sbatch --array=1-N}
name=$(basename "$result" .h5)
mkdir -p shards
exec wormdrive sweep "$study" --shard "$SLURM_ARRAY_TASK_ID/$shards" --threads "${SLURM_CPUS_PER_TASK:-1}" --resume \
  -o "shards/${name}_${SLURM_ARRAY_TASK_ID}_of_$shards.h5" --quiet
