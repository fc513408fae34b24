#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "bindings/fmi/instance.hpp"
#include "bindings/fmi/plant_parameters.hpp"

namespace wormdrive {
namespace {

/// 52 bits of Fowler, Noll and Vo's hash 1a.
double digest_of(const void* bytes, std::size_t size) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (std::size_t k = 0; k < size; ++k) hash = (hash ^ static_cast<const unsigned char*>(bytes)[k]) * 0x100000001b3U;
  return static_cast<double>(hash >> 12);
}
double digest_of(std::span<const double> numbers) { return digest_of(numbers.data(), numbers.size_bytes()); }

[[noreturn]] void reject_state(const char* why) {
  throw std::invalid_argument(std::string("the bytes are no state of this FMU: ") + why);
}

}  // namespace

std::vector<double> FmuInstance::to_numbers(const Kept& kept) const {
  const State& s = kept.state;
  if (!can_be_serialized(stated_)) throw std::logic_error("a lagged torque over time has no state in numbers");
  if (s.halted) throw std::logic_error("the drive has halted and has no state to come back to");
  std::vector<double> numbers{digest_of(stated_.token.data(), stated_.token.size()),
                              double(type_ == InterfaceType::co_simulation),
                              double(static_cast<unsigned>(s.phase)),
                              s.experiment.start,
                              double(s.experiment.stop.has_value()),
                              s.experiment.stop.value_or(0.0),
                              double(s.experiment.tolerance.has_value()),
                              s.experiment.tolerance.value_or(0.0),
                              s.time,
                              s.torque,
                              double(s.takes_sample),
                              double(s.run.has_value())};
  for (const auto& parameter : plant_parameters(kept.set)) numbers.push_back(*parameter.value);
  if (s.run) std::visit([&](const auto& run) { run.write(numbers); }, *s.run);
  numbers.push_back(digest_of(numbers));
  return numbers;
}

FmuInstance::Kept FmuInstance::from_numbers(std::span<const double> numbers) const {
  if (numbers.empty() || digest_of(numbers.first(numbers.size() - 1)) != numbers.back())
    reject_state("they are damaged");
  NumberReader next(numbers.first(numbers.size() - 1));
  if (next() != digest_of(stated_.token.data(), stated_.token.size())) reject_state("they are another FMU's");
  if ((next() != 0.0) != (type_ == InterfaceType::co_simulation)) reject_state("they are of the other interface type");
  FmuInstance made(stated_, type_);
  State& s = made.state_;
  s.uses_event_mode = state_.uses_event_mode;
  s.phase = static_cast<Phase>(static_cast<unsigned>(next()));
  s.experiment.start = next();
  const bool has_stop = next() != 0.0;
  if (const double stop = next(); has_stop) s.experiment.stop = stop;
  const bool has_tolerance = next() != 0.0;
  if (const double tolerance = next(); has_tolerance) s.experiment.tolerance = tolerance;
  const double time = next();
  s.torque = next();
  s.takes_sample = next() != 0.0;
  const bool runs = next() != 0.0;
  for (const auto& parameter : plant_parameters(made.model_.scenario)) *parameter.value = next();
  s.time = s.experiment.start;
  if (runs) {
    made.begin();
    if (!std::visit([&](auto& run) { return run.read(next.rest()); }, *s.run)) reject_state("they are damaged");
  }
  s.time = time;
  return made.keep();
}

}  // namespace wormdrive
