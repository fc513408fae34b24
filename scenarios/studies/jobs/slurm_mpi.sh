#!/usr/bin/env bash
# A sweep as one MPI job: ranks take trials as they finish others; the same line again goes on where it ended.
#
#   sbatch --ntasks=128 slurm_mpi.sh study.toml sweep.h5
#SBATCH --job-name=wormdrive
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --signal=TERM@60
set -euo pipefail

exec mpirun wormdrive sweep "$1" --threads "${SLURM_CPUS_PER_TASK:-1}" --resume -o "$2"
