#pragma once
#include <functional>

namespace wormdrive {

inline constexpr int bad_input = 2, cannot_go_on = 3, cannot_write = 4;

/// The exit code of a command, which tells what it throws in one line.
int guarded(const std::function<int()>& command);

/// The exit code, unless what was printed could not be written.
int if_printed(int code);

}  // namespace wormdrive
