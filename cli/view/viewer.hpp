#pragma once
#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/report/page.hpp"
#include "cli/view/slider.hpp"

namespace wormdrive {

/// A run was given up: a later one was asked for, or the program ends.
struct Superseded : std::runtime_error {
  Superseded() : std::runtime_error("a later run was asked for") {}
};

/// Runs one scenario again and again with other numbers, for who looks at it. May be used by several threads.
class Viewer {
 public:
  /// Throws InputFault for a scenario that cannot be run, or sliders that it has not.
  Viewer(std::string file, std::vector<std::string> overrides, const std::vector<std::string>& vary);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer();

  const std::vector<Slider>& sliders() const { return sliders_; }
  const std::string& file() const { return file_; }
  const std::vector<std::string>& overrides() const { return overrides_; }

  /// The page of a run with these values of sliders, by key; a run that is still under way gives up. Throws InputFault,
  /// SimulationFailure, OutputFault, or Superseded.
  ReportPage page(const std::map<std::string, double>& values);
  /// Gives up whatever is under way.
  void give_up() { ++newest_; }

 private:
  std::string file_;
  std::vector<std::string> overrides_;
  std::vector<Slider> sliders_;
  std::filesystem::path folder_;  ///< of the run that is looked at, for this program alone
  std::mutex running_;
  std::atomic<unsigned> newest_{0};
};

}  // namespace wormdrive
