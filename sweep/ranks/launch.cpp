#include "sweep/ranks/launch.hpp"

#include <cstdlib>
#include <initializer_list>
#include <utility>

namespace wormdrive {
namespace {

bool has(const char* variable) { return std::getenv(variable) != nullptr; }
long number(const char* variable) { return has(variable) ? std::strtol(std::getenv(variable), nullptr, 10) : 0; }

}  // namespace

Launch launch() {
  // srun --mpi=pmi2 says PMI_SIZE too
  const std::string by = has("SLURM_STEP_NUM_TASKS") && !has("OMPI_COMM_WORLD_SIZE") ? "srun" : "mpirun";
  for (const auto& [size, rank] : {std::pair{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                   {"PMI_SIZE", "PMI_RANK"},
                                   {"MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK"}})
    if (has(size)) return {by, number(size), number(rank), true};
  const bool meets = has("PMIX_RANK") || has("PMI_RANK") || has("PMI_FD");
  // of the step, not of the job: a batch script has SLURM_NTASKS too, and is a single process
  if (by == "srun") return {by, number("SLURM_STEP_NUM_TASKS"), number("SLURM_PROCID"), meets};
  if (meets) return {by, 0, number("PMIX_RANK"), true};
  return {};
}

}  // namespace wormdrive
