#pragma once
#include <chrono>
#include <exception>

#include <pybind11/pybind11.h>

namespace wormdrive {

/// Python has taken a signal, as of Ctrl-C; its exception is set.
struct Interrupted : std::exception {};

/// Lets Python look for signals now and then while C++ works without its lock. Throws Interrupted.
class SignalWatch {
 public:
  void operator()() {
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + interval;
    const pybind11::gil_scoped_acquire python;
    if (PyErr_CheckSignals() != 0) throw Interrupted{};
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto interval = std::chrono::milliseconds(50);
  Clock::time_point next_ = Clock::now() + interval;
};

/// Calls work(watch) without holding Python up; other threads of Python run meanwhile.
template <class Work>
decltype(auto) without_python(Work&& work) {
  SignalWatch watch;
  try {
    const pybind11::gil_scoped_release others_may_run;
    return work(watch);
  } catch (const Interrupted&) {
    throw pybind11::error_already_set();
  }
}

}  // namespace wormdrive
