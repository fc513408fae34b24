#include "output/program.hpp"

#include <fmt/format.h>

#include "commit.hpp"

namespace wormdrive {

std::string program_version() { return version; }
std::string program_commit() { return commit; }
std::string program_sources() { return sources; }

std::string program_identity() { return fmt::format("wormdrive {} (sources {})", version, sources); }
std::string build_description() {
  return fmt::format("wormdrive {} (sources {}, commit {})", version, sources, commit);
}

}  // namespace wormdrive
