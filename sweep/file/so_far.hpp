#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace wormdrive {

/// A sweep to read from, also one that is still running or was interrupted: then a copy of the trials that it has so
/// far, which stands still and goes with this object.
class SweepSoFar {
 public:
  /// path: NAME, or NAME.part. Where NAME is not there, what one program or the ranks of one have left of it is taken.
  /// Throws InputFault if files of different sweeps stand there.
  explicit SweepSoFar(const std::string& path);
  SweepSoFar(const SweepSoFar&) = delete;
  SweepSoFar& operator=(const SweepSoFar&) = delete;
  ~SweepSoFar();

  /// The file to read.
  const std::string& path() const { return path_; }
  /// Whether a program is making it.
  bool running() const { return running_; }

 private:
  void copy_of(const std::vector<std::string>& parts, const std::string& path);

  std::string path_;
  std::filesystem::path folder_;  ///< of the copy; empty without one
  bool running_ = false;
};

}  // namespace wormdrive
