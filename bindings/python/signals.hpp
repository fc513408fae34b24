#pragma once
#include <ctime>
#include <exception>

#include <pybind11/pybind11.h>

namespace wormdrive {

/// Python has taken a signal, as of Ctrl-C; its exception is set.
struct Interrupted : std::exception {};

/// Lets Python look for signals now and then while C++ works without its lock. Throws Interrupted.
class SignalWatch {
 public:
  void operator()() {
    if (now() < next_) return;
    next_ = now() + interval;
    const pybind11::gil_scoped_acquire python;
    if (PyErr_CheckSignals() != 0) throw Interrupted{};
  }

 private:
  /// Of the coarse clock, for this is asked at every row of a run.
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC_COARSE, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  static constexpr double interval = 0.05;  ///< [s]
  double next_ = now() + interval;
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
