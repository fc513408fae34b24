#pragma once
#include <string>

namespace wormdrive {

/// The right to write a file NAME: whoever looks at what is there of it, writes it and gives it its name holds the lock
/// of NAME.part.lock meanwhile. The file of the lock goes with it; one that a killed program left locks nothing.
class OutputLock {
 public:
  /// Holds nothing.
  OutputLock() = default;
  /// Throws OutputFault where another program holds it. Where files cannot be locked, or none can be made, nobody does.
  explicit OutputLock(const std::string& path);
  OutputLock(OutputLock&& other) noexcept;
  OutputLock& operator=(OutputLock&& other) noexcept;
  ~OutputLock();

 private:
  std::string file_;
  int descriptor_ = -1;
};

}  // namespace wormdrive
