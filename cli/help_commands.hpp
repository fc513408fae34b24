#pragma once
#include <string>
#include <vector>

#include "output/replacing.hpp"

namespace wormdrive {

/// Prints the JSON schema of scenarios.
int schema_command();

struct NewOptions {
  std::string file;
  std::string kind;  ///< one of new_kinds()
};
/// What `wormdrive new --kind` may be.
std::vector<std::string> new_kinds();
int new_command(const NewOptions& options);

struct DiffOptions {
  std::string first, second;
  double relative = 1e-6;  ///< difference allowed, as a share of the signal's largest magnitude
  double absolute = 0.0;   ///< difference allowed, in the signal's units
  double time = 1e-6;      ///< difference of event times allowed [s]
  bool quiet = false;
  bool json = false;
};
/// 0 where two results agree, 1 where they differ.
int diff_command(const DiffOptions& options);

struct ReportOptions {
  std::string file;
  std::string output;  ///< empty: named after the file
  Replace replace = Replace::same_kind;
};
int report_command(const ReportOptions& options);

}  // namespace wormdrive
