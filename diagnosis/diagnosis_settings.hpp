#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace wormdrive {

/// How well a stated parameter is known: the truth lies about it with this standard deviation. Such a number stays free
/// in every fit, and is a cause only where it lies far outside.
struct Tolerance {
  std::string effect;  ///< whose field says by how much the number is off: "mesh_friction"
  std::string field;   ///< "change"
  double deviation;    ///< in SI; 0: exactly known
};

/// What a diagnosis is asked for beside scenario and recordings.
struct DiagnosisSettings {
  std::vector<Tolerance> tolerances{};  ///< in place of the defaults of the same field
  std::uint64_t seed = 1;               ///< of bootstraps
  int draws = 0;                        ///< of the numbers that are fitted to a recording, by fitting them so often
  int threads = 2;                      ///< results do not depend on it
  int most_causes = 4;
  std::function<void(const std::string&)> progress{};  ///< is told what goes on, a phrase at a time; may be empty
};

}  // namespace wormdrive
