#pragma once
#include <string>

namespace wormdrive {

// What this program is, apart from the files that it writes: compiled alone, for it changes with every source.

std::string program_version();  ///< "0.1.0"
std::string program_commit();   ///< "1284fb05523e", "-dirty" behind it for changed sources; "unknown" without git
/// Digest of the sources that decide results, "3f2a9c01d2e4"; that of a changed tree is another one, with git or
/// without.
std::string program_sources();

/// What the rows of a sweep hang on, whatever the commit: "wormdrive 0.1.0 (sources 3f2a9c01d2e4)".
std::string program_identity();
/// "wormdrive 0.1.0 (sources 3f2a9c01d2e4, commit 1284fb05523e)"
std::string build_description();

}  // namespace wormdrive
