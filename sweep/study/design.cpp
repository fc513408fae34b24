#include "sweep/study/design.hpp"

#include <algorithm>
#include <numeric>

#include "sweep/study/keyed_permutation.hpp"
#include "sweep/study/random.hpp"

namespace wormdrive {
namespace {

std::uint64_t count(const MonteCarlo& design, std::size_t) { return design.trials; }
std::uint64_t count(const LatinHypercube& design, std::size_t) { return design.trials; }
std::uint64_t count(const SobolSequence& design, std::size_t) { return design.trials; }
std::uint64_t count(const Saltelli& design, std::size_t parameters) { return design.samples * (parameters + 2); }
std::uint64_t count(const Grid& design, std::size_t) {
  return std::accumulate(design.levels.begin(), design.levels.end(), std::uint64_t{1}, std::multiplies<>());
}
std::uint64_t count(const OneAtATime& design, std::size_t) {
  return std::accumulate(design.levels.begin(), design.levels.end(), std::uint64_t{1});
}
std::uint64_t count(const Morris& design, std::size_t parameters) { return design.trajectories * (parameters + 1); }
std::uint64_t count(const TableOfPoints& design, std::size_t) { return design.trials; }

/// Coordinates that the sequence of a design needs; 1 for a design that has none, for 0 is refused.
std::size_t sequence_dimension(const DesignSettings& settings, std::size_t parameters) {
  if (std::holds_alternative<SobolSequence>(settings)) return parameters;
  return std::holds_alternative<Saltelli>(settings) ? 2 * parameters : 1;
}

}  // namespace

double middle_of(std::uint64_t level, std::uint64_t levels) {
  return (static_cast<double>(level) + 0.5) / static_cast<double>(levels);
}

bool goes_by_levels(const DesignSettings& settings) {
  return std::holds_alternative<Grid>(settings) || std::holds_alternative<OneAtATime>(settings);
}
bool allows_correlation(const DesignSettings& settings) {
  return std::holds_alternative<MonteCarlo>(settings) || std::holds_alternative<LatinHypercube>(settings) ||
         std::holds_alternative<SobolSequence>(settings);
}
bool is_sample(const DesignSettings& settings) {
  return allows_correlation(settings) || std::holds_alternative<Saltelli>(settings);
}

std::uint64_t noise_of(const DesignSettings& settings, std::size_t parameters, std::uint64_t trial) {
  if (std::holds_alternative<Morris>(settings)) return trial - trial % (parameters + 1);
  const std::uint64_t block = trial % (parameters + 2);
  return std::holds_alternative<Saltelli>(settings) && block >= 2 ? trial - block : trial;
}

std::uint64_t size(const DesignSettings& settings, std::size_t parameters) {
  return std::visit([&](const auto& design) { return count(design, parameters); }, settings);
}

Design::Design(DesignSettings settings, std::size_t parameters, std::uint64_t seed,
               std::shared_ptr<const CorrelatedStrata> strata)
    : settings_(std::move(settings)),
      parameters_(parameters),
      seed_(seed),
      strata_(std::move(strata)),
      sequence_(sequence_dimension(settings_, parameters)) {
  shifts_.resize(std::holds_alternative<Saltelli>(settings_) ? Saltelli::replicates : 1);
  for (std::uint64_t replicate = 0; replicate < shifts_.size(); ++replicate)
    for (std::uint64_t k = 0; k < sequence_.dimension(); ++k)
      shifts_[replicate].push_back(random_bits(seed, SweepStream::digital_shift, replicate, k)[0]);
}

std::vector<double> Design::point(std::uint64_t trial) {
  return std::visit([&](const auto& design) { return at(design, trial); }, settings_);
}

double Design::draw(std::uint64_t trial, std::size_t parameter) const {
  return to_unit_interval(random_bits(seed_, SweepStream::draws, trial, parameter)[0]);
}

std::vector<double> Design::at(const MonteCarlo&, std::uint64_t trial) const {
  std::vector<double> u(parameters_);
  for (std::size_t k = 0; k < parameters_; ++k) u[k] = draw(trial, k);
  return u;
}

std::vector<double> Design::at(const LatinHypercube& design, std::uint64_t trial) const {
  std::vector<double> u(parameters_);
  for (std::size_t k = 0; k < parameters_; ++k) {
    const std::uint64_t stratum = strata_ ? (*strata_)(trial, k) : KeyedPermutation(design.trials, seed_, k)(trial);
    u[k] =
        std::min((static_cast<double>(stratum) + draw(trial, k)) / static_cast<double>(design.trials), 1.0 - 0x1p-53);
  }
  return u;
}

std::vector<double> Design::sobol(std::uint64_t row, std::uint64_t replicate) {
  // Boost leaves out the origin. Shifted it is a point like any other, and the first 2^m are even only with it.
  if (row > 0) sequence_.seed(row - 1);
  const std::vector<std::uint64_t>& shift = shifts_[replicate];
  std::vector<double> u(shift.size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = to_unit_interval((row > 0 ? sequence_() : 0) ^ shift[k]);
  return u;
}

std::vector<double> Design::at(const SobolSequence&, std::uint64_t trial) { return sobol(trial, 0); }

std::vector<double> Design::at(const Saltelli&, std::uint64_t trial) {
  const std::uint64_t block = trial % (parameters_ + 2), sample = trial / (parameters_ + 2);
  const std::vector<double> both = sobol(sample / Saltelli::replicates, sample % Saltelli::replicates);
  const auto B = both.begin() + static_cast<std::ptrdiff_t>(parameters_);
  if (block == 1) return {B, both.end()};
  std::vector<double> u(both.begin(), B);
  if (block >= 2) u[block - 2] = both[parameters_ + block - 2];
  return u;
}

std::vector<double> Design::at(const Grid& design, std::uint64_t trial) const {
  std::vector<double> u(parameters_);
  for (std::size_t k = parameters_; k-- > 0; trial /= design.levels[k])
    u[k] = middle_of(trial % design.levels[k], design.levels[k]);
  return u;
}

std::vector<double> Design::at(const OneAtATime& design, std::uint64_t trial) const {
  std::vector<double> u = design.medians;
  std::uint64_t left = trial - 1;
  for (std::size_t k = 0; trial > 0 && k < parameters_; left -= design.levels[k++])
    if (left < design.levels[k]) {
      u[k] = middle_of(left, design.levels[k]);
      break;
    }
  return u;
}

std::vector<double> Design::at(const TableOfPoints& design, std::uint64_t trial) const {
  return std::vector<double>(parameters_, middle_of(trial, design.trials));
}

std::vector<double> Design::at(const Morris& design, std::uint64_t trial) const {
  const std::uint64_t trajectory = trial / (parameters_ + 1), step = trial % (parameters_ + 1),
                      half = design.levels / 2;
  struct Course {
    std::uint64_t turn;  ///< the parameter with the least one changes first
    std::size_t parameter;
    std::uint64_t lower;  ///< of the two levels
    bool rises;
  };
  std::vector<Course> courses;
  for (std::size_t k = 0; k < parameters_; ++k) {
    const auto [level, direction, turn, unused] = random_bits(seed_, SweepStream::draws, trajectory, k);
    const auto lower = static_cast<std::uint64_t>(to_unit_interval(level) * static_cast<double>(half));
    courses.push_back({turn, k, std::min(lower, half - 1), direction % 2 == 0});
  }
  std::sort(courses.begin(), courses.end(), [](const Course& a, const Course& b) {
    return std::pair(a.turn, a.parameter) < std::pair(b.turn, b.parameter);
  });
  std::vector<double> u(parameters_);
  for (std::uint64_t place = 0; place < parameters_; ++place) {
    const Course& course = courses[place];
    const bool up = (place < step) == course.rises;
    u[course.parameter] = middle_of(course.lower + (up ? half : 0), design.levels);
  }
  return u;
}

}  // namespace wormdrive
