#pragma once
#include <algorithm>
#include <string>

namespace wormdrive {

/// A text without line breaks and other control characters, which a key or the name of a file may hold.
inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text;
}

}  // namespace wormdrive
