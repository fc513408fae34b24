#pragma once
#include <functional>
#include <string>

namespace wormdrive {

inline constexpr int bad_input = 2, cannot_go_on = 3, cannot_write = 4;

/// The exit code of a command, which tells what it throws in one line. who: whom a fault that names no file begins
/// with.
int guarded(const std::function<int()>& command, const std::string& who = "wormdrive");

/// The exit code, unless what was printed could not be written.
int if_printed(int code);

}  // namespace wormdrive
