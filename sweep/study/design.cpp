#include "sweep/study/design.hpp"

#include <algorithm>
#include <numeric>

#include <boost/random/sobol.hpp>

#include "sweep/study/keyed_permutation.hpp"
#include "sweep/study/random.hpp"

namespace wormdrive {
namespace {

std::uint64_t count(const MonteCarlo& design, std::size_t) { return design.trials; }
std::uint64_t count(const LatinHypercube& design, std::size_t) { return design.trials; }
std::uint64_t count(const SobolSequence& design, std::size_t) { return design.trials; }
std::uint64_t count(const Saltelli& design, std::size_t parameters) { return design.samples * design.rows(parameters); }
std::uint64_t count(const Grid& design, std::size_t) {
  return std::accumulate(design.levels.begin(), design.levels.end(), std::uint64_t{1}, std::multiplies<>());
}
std::uint64_t count(const OneAtATime& design, std::size_t) {
  return std::accumulate(design.levels.begin(), design.levels.end(), std::uint64_t{1});
}
std::uint64_t count(const Morris& design, std::size_t parameters) { return design.trajectories * (parameters + 1); }
std::uint64_t count(const Shapley& design, std::size_t parameters) { return design.permutations * (parameters + 1); }
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
bool draws_each_trial(const DesignSettings& settings) {
  return std::holds_alternative<MonteCarlo>(settings) || std::holds_alternative<LatinHypercube>(settings) ||
         std::holds_alternative<SobolSequence>(settings);
}
bool allows_correlation(const DesignSettings& settings) {
  return draws_each_trial(settings) || std::holds_alternative<Shapley>(settings);
}
bool is_sample(const DesignSettings& settings) {
  return allows_correlation(settings) || std::holds_alternative<Saltelli>(settings);
}

Block block_of(const DesignSettings& settings, std::size_t parameters) {
  if (std::holds_alternative<Shapley>(settings)) return {parameters + 1, 1};
  if (const auto* const saltelli = std::get_if<Saltelli>(&settings)) return {saltelli->rows(parameters), 2};
  return {};
}

std::uint64_t noise_of(const DesignSettings& settings, std::size_t parameters, std::uint64_t trial) {
  if (std::holds_alternative<Morris>(settings) || std::holds_alternative<Shapley>(settings))
    return trial - trial % (parameters + 1);
  const auto* const saltelli = std::get_if<Saltelli>(&settings);
  if (!saltelli) return trial;
  const std::uint64_t row = trial % saltelli->rows(parameters);
  return trial - row + (row < 2 ? row : row < parameters + 2 ? 0 : 1);
}

std::uint64_t size(const DesignSettings& settings, std::size_t parameters) {
  return std::visit([&](const auto& design) { return count(design, parameters); }, settings);
}

struct Design::Sequence : boost::random::sobol {
  using boost::random::sobol::sobol;
};

Design::Design(DesignSettings settings, std::size_t parameters, std::uint64_t seed,
               std::shared_ptr<const CorrelatedStrata> strata)
    : settings_(std::move(settings)),
      parameters_(parameters),
      seed_(seed),
      strata_(std::move(strata)),
      sequence_(std::make_unique<Sequence>(sequence_dimension(settings_, parameters))) {
  shifts_.resize(std::holds_alternative<Saltelli>(settings_) ? Saltelli::replicates : 1);
  for (std::uint64_t replicate = 0; replicate < shifts_.size(); ++replicate)
    for (std::uint64_t k = 0; k < sequence_->dimension(); ++k)
      shifts_[replicate].push_back(random_bits(seed, SweepStream::digital_shift, replicate, k)[0]);
}

Design::~Design() = default;

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
  if (row > 0) sequence_->seed(row - 1);
  const std::vector<std::uint64_t>& shift = shifts_[replicate];
  std::vector<double> u(shift.size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = to_unit_interval((row > 0 ? (*sequence_)() : 0) ^ shift[k]);
  return u;
}

std::vector<double> Design::at(const SobolSequence&, std::uint64_t trial) { return sobol(trial, 0); }

std::vector<double> Design::at(const Saltelli& design, std::uint64_t trial) {
  const std::uint64_t rows = design.rows(parameters_), row = trial % rows, sample = trial / rows;
  const std::vector<double> both = sobol(sample / Saltelli::replicates, sample % Saltelli::replicates);
  const auto middle = both.begin() + static_cast<std::ptrdiff_t>(parameters_);
  const std::vector<double> A(both.begin(), middle), B(middle, both.end());
  const bool of_B = row == 1 || row >= parameters_ + 2;
  std::vector<double> u = of_B ? B : A;
  if (row >= 2) {
    const std::uint64_t other = (row - 2) % parameters_;
    u[other] = (of_B ? A : B)[other];
  }
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
  const std::vector<std::size_t> courses = order(trajectory);
  std::vector<double> u(parameters_);
  for (std::uint64_t place = 0; place < parameters_; ++place) {
    const std::size_t parameter = courses[place];
    const auto bits = random_bits(seed_, SweepStream::draws, trajectory, parameter);
    const auto lower = static_cast<std::uint64_t>(to_unit_interval(bits[0]) * static_cast<double>(half));
    const bool rises = bits[1] % 2 == 0, up = (place < step) == rises;
    u[parameter] = middle_of(std::min(lower, half - 1) + (up ? half : 0), design.levels);
  }
  return u;
}

std::vector<double> Design::at(const Shapley& design, std::uint64_t trial) const {
  const std::uint64_t permutation = trial / (parameters_ + 1), step = trial % (parameters_ + 1);
  const std::vector<std::size_t> drawn = order(permutation);
  std::vector<double> in_order(parameters_), u(parameters_);
  for (std::uint64_t place = 0; place < parameters_; ++place) {
    const auto bits = random_bits(seed_, SweepStream::draws, permutation, drawn[place]);
    const bool anew = step > 0 && place + 1 >= step;
    in_order[place] = to_unit_interval(bits[anew ? 1 : 0]);
  }
  design.copula.reordered(drawn).apply(in_order);
  for (std::uint64_t place = 0; place < parameters_; ++place) u[drawn[place]] = in_order[place];
  return u;
}

std::vector<std::size_t> Design::order(std::uint64_t key) const {
  std::vector<std::pair<std::uint64_t, std::size_t>> turns;
  for (std::size_t k = 0; k < parameters_; ++k)
    turns.emplace_back(random_bits(seed_, SweepStream::draws, key, k)[2], k);
  std::sort(turns.begin(), turns.end());
  std::vector<std::size_t> parameters;
  for (const auto& turn : turns) parameters.push_back(turn.second);
  return parameters;
}

}  // namespace wormdrive
