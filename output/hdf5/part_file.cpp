#include "output/hdf5/part_file.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <unistd.h>

#include <Eigen/Core>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sundials/sundials_version.h>
#include <sys/file.h>

#include "output/program.hpp"

namespace wormdrive {
namespace {

void rename(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0)
    throw OutputFault(fmt::format("cannot rename {} to {}: {}", from, to, std::strerror(errno)));
}

void remove_quietly(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
}

}  // namespace

bool is_being_written(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool taken = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return taken;
}

void reject_if_being_written(const std::string& part_path) {
  const int descriptor = ::open(part_path.c_str(), O_RDONLY);
  if (descriptor < 0) return;
  const bool taken = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  if (taken) throw OutputFault(fmt::format("cannot write {}: another program is writing it", part_path));
}

void synchronise(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  if (descriptor < 0) return;
  const bool lost = ::fsync(descriptor) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  const int reason = errno;
  ::close(descriptor);
  if (lost) throw OutputFault(fmt::format("cannot write {}: {}", path, std::strerror(reason)));
}

PartFile::PartFile(const std::string& path, std::string_view kind, Replace replace)
    : path_(followed(path)), part_path_(path_ + ".part") {
  reject_unless_plain_file(path_);
  lock_ = OutputLock(path_);
  create(kind, replace);
}

PartFile::PartFile(const std::string& path, OutputLock lock, std::string_view kind, Replace replace)
    : path_(followed(path)), part_path_(path_ + ".part"), lock_(std::move(lock)) {
  create(kind, replace);
}

void PartFile::create(std::string_view kind, Replace replace) {
  Hdf5Handle::forget_losses();  // of files that were read
  reject_if_being_written(part_path_);
  reject_replacing(path_, kind, replace);
  try {
    file_ = create_hdf5(part_path_);
  } catch (const OutputFault&) {
    remove_quietly(part_path_);
    throw;
  }
}

PartFile::PartFile(const std::string& path, std::string_view kind, Replace replace, Left)
    : path_(followed(path)), part_path_(path_ + ".part"), stays_(true) {
  Hdf5Handle::forget_losses();
  reject_if_being_written(part_path_);
  reject_replacing(path_, kind, replace);
  file_ = reopen_hdf5(part_path_);
}

PartFile::~PartFile() {
  file_ = Hdf5Handle();
  if (!stays_) remove_quietly(part_path_);
}

void PartFile::flush() {
  check_hdf5(H5Fflush(file_, H5F_SCOPE_LOCAL), "cannot write " + part_path_);
  Hdf5Handle::reject_losses("cannot write " + part_path_);
}

void PartFile::keep() {
  flush();
  stays_ = true;
}

void PartFile::finish() {
  flush();
  file_.close("cannot write " + part_path_);
  synchronise(part_path_);
  rename(part_path_, path_);
  stays_ = true;
}

void PartFile::give_way_to(const std::string& other) {
  rename(other, path_);
  stays_ = false;
}

void write_provenance(hid_t file, const Provenance& provenance) {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  write_attribute(file, "title", provenance.title);
  write_attribute(file, "kind", provenance.kind);
  write_attribute(file, "scenario", provenance.scenario);
  write_attribute(file, "command_line", provenance.command_line);
  write_attribute(file, "wormdrive_version", program_version());
  write_attribute(file, "commit", program_commit());
  write_attribute(file, "sources", program_sources());
  write_attribute(file, "libraries",
                  fmt::format("SUNDIALS {}, HDF5 {}.{}.{}, Eigen {}.{}.{}", SUNDIALS_VERSION, major, minor, release,
                              EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  write_attribute(file, "created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
}

}  // namespace wormdrive
