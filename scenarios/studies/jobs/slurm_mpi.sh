#!/usr/bin/env bash
# A sweep as one MPI job: ranks take trials as they finish others; the same line again goes on where it ended.
#
#   sbatch --ntasks=128 slurm_mpi.sh study.toml sweep.h5
#SBATCH --job-name=wormdrive
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
# A minute before the end the batch shell, which mpirun is by exec, gets SIGTERM and passes it on to the ranks. Open MPI
# kills them a second later unless it is told to wait that long while they finish the trials that they have begun.
#SBATCH --signal=B:TERM@60
set -euo pipefail

export OMPI_MCA_odls_base_sigkill_timeout=${OMPI_MCA_odls_base_sigkill_timeout:-20}
exec mpirun wormdrive sweep "$1" --threads "${SLURM_CPUS_PER_TASK:-1}" --resume -o "$2"
