#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace wormdrive {

/// A progress bar on the terminal for whatever takes longer than a second; silent where stderr is no terminal.
class Progress {
 public:
  explicit Progress(double end, bool quiet);
  ~Progress();
  /// Tells how far the work has come, in the unit of `end`; cheap enough to call at every row. note(): what else is
  /// to be told, asked for when it is drawn.
  void at(double now, const std::function<std::string(double seconds)>& note = {});

 private:
  using Clock = std::chrono::steady_clock;
  double end_;
  bool wanted_;
  bool drawn_ = false;
  int calls_ = 0;
  Clock::time_point begin_ = Clock::now(), latest_ = begin_;
};

}  // namespace wormdrive
