#include "output/part_file.hpp"

#include <fcntl.h>
#include <sundials/sundials_version.h>
#include <unistd.h>

#include <Eigen/Core>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "commit.hpp"

namespace wormdrive {
namespace {

/// On disk before it gets its name: a rename may otherwise outlive the data in a power cut.
void synchronise(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

PartFile::PartFile(std::string path) : path_(std::move(path)), part_path_(path_ + ".part") {
  const auto status = std::filesystem::status(path_);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw OutputFault(fmt::format("cannot write {}: it is not a plain file", path_));
  file_ = create_hdf5(part_path_);
}

void PartFile::flush() {
  errno = 0;
  check_hdf5(H5Fflush(file_, H5F_SCOPE_LOCAL), "cannot write " + part_path_);
}

void PartFile::finish() {
  flush();
  file_.close("cannot write " + part_path_);
  synchronise(part_path_);
  if (std::rename(part_path_.c_str(), path_.c_str()) != 0)
    throw OutputFault(fmt::format("cannot rename {} to {}: {}", part_path_, path_, std::strerror(errno)));
}

void PartFile::discard() noexcept {
  file_ = Hdf5Handle();
  std::error_code ignored;
  std::filesystem::remove(part_path_, ignored);
}

void write_provenance(hid_t file, const Provenance& provenance) {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  write_attribute(file, "title", provenance.title);
  write_attribute(file, "kind", provenance.kind);
  write_attribute(file, "scenario", provenance.scenario);
  write_attribute(file, "command_line", provenance.command_line);
  write_attribute(file, "wormdrive_version", std::string(version));
  write_attribute(file, "commit", std::string(commit));
  write_attribute(file, "libraries", fmt::format("SUNDIALS {}, HDF5 {}.{}.{}, Eigen {}.{}.{}", SUNDIALS_VERSION,
                                                 major, minor, release, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                                                 EIGEN_MINOR_VERSION));
  write_attribute(file, "created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
}

std::string build_description() { return fmt::format("wormdrive {} ({})", version, commit); }

}  // namespace wormdrive
