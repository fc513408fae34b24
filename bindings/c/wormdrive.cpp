#include "bindings/c/wormdrive.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "events/simulation_failure.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/stepping/stepped_drive.hpp"

struct wormdrive_drive {
  std::unique_ptr<wormdrive::SteppedDrive> drive;
  std::string set_aside, columns;
};

namespace wormdrive {
namespace {

thread_local std::string latest_error;

/// Calls use(); no exception passes the C interface.
template <class Use>
int guarded(Use&& use) {
  try {
    use();
    return WORMDRIVE_OK;
  } catch (const SimulationFailure& halt) {
    latest_error = halt.what();
    return WORMDRIVE_HALTED;
  } catch (const std::exception& fault) {
    latest_error = fault.what();
    return WORMDRIVE_BAD_INPUT;
  }
}

void require(const void* pointer, const char* what) {
  if (!pointer) throw std::invalid_argument(std::string(what) + " is a null pointer");
}

template <class Load>
wormdrive_drive* made(Load&& load) {
  std::unique_ptr<wormdrive_drive> made;
  guarded([&] {
    const Scenario scenario = load();
    auto drive = make_stepped_drive(scenario);
    const std::vector<std::string> columns = drive->columns();
    made.reset(new wormdrive_drive{std::move(drive), fmt::format("{}", fmt::join(set_aside(scenario), "\n")),
                                   fmt::format("{}", fmt::join(columns, "\n"))});
  });
  return made.release();
}

void show(const SteppedDrive& drive, wormdrive_state& to) {
  const StepState s = drive.state();
  to = {
      s.t,       s.at.theta_g, s.at.omega_g,           s.at.alpha_g,         s.at.tau_m, s.at.tau_l, s.at.normal_force,
      s.theta_w, s.omega_w,    sign(s.at.mode.motion), sign(s.at.mode.flank)};
}

}  // namespace
}  // namespace wormdrive

using namespace wormdrive;

wormdrive_drive* wormdrive_open(const char* path) {
  return made([&] {
    require(path, "path");
    return load_scenario(path, {}, Purpose::look);
  });
}
wormdrive_drive* wormdrive_parse(const char* toml) {
  return made([&] {
    require(toml, "toml");
    return parse_scenario(toml, "text", {}, Purpose::look);
  });
}
void wormdrive_close(wormdrive_drive* drive) { delete drive; }

const char* wormdrive_set_aside(const wormdrive_drive* drive) { return drive ? drive->set_aside.c_str() : ""; }

int wormdrive_step(wormdrive_drive* drive, double torque, double dt, wormdrive_state* state) {
  return guarded([&] {
    require(drive, "drive");
    drive->drive->step(torque, dt);
    if (state) show(*drive->drive, *state);
  });
}
int wormdrive_get_state(const wormdrive_drive* drive, wormdrive_state* state) {
  return guarded([&] {
    require(drive, "drive");
    require(state, "state");
    show(*drive->drive, *state);
  });
}
const char* wormdrive_columns(const wormdrive_drive* drive) { return drive ? drive->columns.c_str() : ""; }
int wormdrive_get_value(const wormdrive_drive* drive, const char* column, double* value) {
  return guarded([&] {
    require(drive, "drive");
    require(column, "column");
    require(value, "value");
    *value = drive->drive->value(column);
  });
}
int wormdrive_reset(wormdrive_drive* drive) {
  return guarded([&] {
    require(drive, "drive");
    drive->drive->reset();
  });
}

size_t wormdrive_snapshot(const wormdrive_drive* drive, double* numbers, size_t capacity) {
  size_t count = 0;
  guarded([&] {
    require(drive, "drive");
    const std::vector<double> kept = drive->drive->snapshot();
    if (numbers && kept.size() > capacity)
      throw std::invalid_argument(
          fmt::format("the snapshot has {} numbers, more than the capacity of {}", kept.size(), capacity));
    if (numbers) std::copy(kept.begin(), kept.end(), numbers);
    count = kept.size();
  });
  return count;
}
int wormdrive_restore(wormdrive_drive* drive, const double* numbers, size_t count) {
  return guarded([&] {
    require(drive, "drive");
    require(numbers, "numbers");
    drive->drive->restore({numbers, count});
  });
}

const char* wormdrive_error(void) { return latest_error.c_str(); }
