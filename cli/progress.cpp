#include "cli/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

namespace wormdrive {

Progress::Progress(double end, bool quiet) : end_(end), wanted_(!quiet && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (drawn_) fmt::print(stderr, "\r{:<100}\r", "");
}

void Progress::at(double now, const std::function<std::string(double)>& note) {
  constexpr int calls_between_looks = 16;
  if (!wanted_ || ++calls_ % calls_between_looks != 0) return;
  const auto time = Clock::now();
  if (time - begin_ < std::chrono::seconds(1) || time - latest_ < std::chrono::milliseconds(100)) return;
  latest_ = time;
  drawn_ = true;
  constexpr int width = 30;
  const double share = std::clamp(now / end_, 0.0, 1.0);
  const double passed = std::chrono::duration<double>(time - begin_).count();
  const double left = passed * (1.0 - share) / std::max(share, 1e-9);
  const std::string bar(static_cast<std::size_t>(share * width), '#');
  fmt::print(stderr, "\r  [{:<{}}] {:3.0f} %, {:.0f} s left{} ", bar, width, 100.0 * share, left,
             note ? note(passed) : "");
  std::fflush(stderr);
}

}  // namespace wormdrive
