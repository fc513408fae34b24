#pragma once
#include <string>

namespace wormdrive {

struct DiffOptions {
  std::string first, second;
  double relative = 1e-6;  ///< difference allowed, as a share of the signal's largest magnitude
  double absolute = 0.0;   ///< difference allowed, in the signal's units
  double time = 1e-6;      ///< difference of event times allowed [s]
  bool quiet = false;
  bool json = false;
};

/// Whether a file holds trials of a sweep, finished or not.
bool is_sweep(const std::string& path);

/// Compares two sweeps trial by trial and prints which trials and columns differ; 0 where they agree, 1 where they
/// differ. Throws InputFault if one is none.
int diff_sweeps(const DiffOptions& options);

}  // namespace wormdrive
