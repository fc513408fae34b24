#!/usr/bin/env bash
# A sweep as one MPI job: ranks take trials as they finish others; the same line again goes on where it ended.
#
#   sbatch --ntasks=128 slurm_mpi.sh study.toml sweep.h5
#SBATCH --job-name=wormdrive
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
# A minute before the end the batch shell, which mpirun is by exec, gets SIGUSR1 and passes it on to the ranks, which
# finish the trials that they have begun. After SIGTERM it would kill them within a second.
#SBATCH --signal=B:USR1@60
set -euo pipefail

exec mpirun wormdrive sweep "$1" --threads "${SLURM_CPUS_PER_TASK:-1}" --resume -o "$2"
