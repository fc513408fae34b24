#include "output/hdf5/output_lock.hpp"

#include <cerrno>
#include <unistd.h>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "output/hdf5/hdf5.hpp"

namespace wormdrive {
namespace {

/// Whether a name still stands for an open file: its last owner may have removed it before this one had the lock.
bool is_still(const std::string& name, int descriptor) {
  struct stat named {
  }, opened{};
  return ::stat(name.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 && named.st_dev == opened.st_dev &&
         named.st_ino == opened.st_ino;
}

}  // namespace

OutputLock::OutputLock(const std::string& path) : file_(path + ".part.lock") {
  constexpr mode_t by_the_group_too = 0666;  // less what the umask takes
  for (;;) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, by_the_group_too);
    if (descriptor_ < 0) return;  // what is written to the same place fails too, and tells why
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const bool taken = errno == EWOULDBLOCK;
      // who only looks whether it is held shares it for that moment
      const bool looked_at = taken && ::flock(descriptor_, LOCK_SH | LOCK_NB) == 0;
      ::close(std::exchange(descriptor_, -1));
      if (looked_at) continue;
      if (taken) throw OutputFault(fmt::format("cannot write {}.part: another program is writing it", path));
      return;
    }
    if (is_still(file_, descriptor_)) return;
    ::close(std::exchange(descriptor_, -1));
  }
}

OutputLock::OutputLock(OutputLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputLock& OutputLock::operator=(OutputLock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

OutputLock::~OutputLock() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());  // while it is locked: nobody else can have it
  ::close(descriptor_);
}

}  // namespace wormdrive
