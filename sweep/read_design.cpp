#include "sweep/read_design.hpp"

#include <cmath>

#include <fmt/format.h>

#include "control/random.hpp"
#include "scenarios/read_reference.hpp"
#include "scenarios/variant_kinds.hpp"
#include "sweep/read_parameters.hpp"

namespace wormdrive {
namespace {

constexpr double most_trials = 1e12;  ///< whoever asks for more has slipped

std::uint64_t whole(TableReader& table, const std::string& key, const Bounds& bounds, std::string_view meaning) {
  const double value = table.number(key, unit::none, bounds, Presence::required, meaning).value_or(1.0);
  require_whole(table, key, value);
  return static_cast<std::uint64_t>(value);
}

class DesignReader {
 public:
  DesignReader(TableReader& table, const Study& study, const std::vector<std::optional<double>>& levels)
      : table_(table), study_(study), levels_(levels) {}

  void read(MonteCarlo& design) { read_trials(design); }
  void read(LatinHypercube& design) { read_trials(design); }
  void read(SobolSequence& design) { read_trials(design); }
  void read(Saltelli& design) {
    design.samples = whole(table_, "samples", bounds::between(2, most_trials / 1e4),
                           "rows of each of the two samples; there are samples (parameters + 2) trials");
  }
  void read(Grid& design) { read_levels(design); }
  void read(OneAtATime& design) { read_levels(design); }

 private:
  template <class Sampled>
  void read_trials(Sampled& design) {
    design.trials = whole(table_, "trials", bounds::between(1, most_trials), "number of trials");
  }

  template <class Levelled>
  void read_levels(Levelled& design) {
    const Bounds range = bounds::between(1, 1e6);
    const auto common = table_.number("levels", unit::none, range, Presence::optional, "levels of each parameter");
    require_whole(table_, "levels", common.value_or(1.0));
    double combinations = 1.0;
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      const auto* const discrete = std::get_if<Discrete>(&study_.parameters[k].distribution);
      const double own = discrete && discrete->weights.empty() ? static_cast<double>(discrete->values.size()) : 5.0;
      const double levels = levels_[k].value_or(discrete ? own : common.value_or(own));
      design.levels.push_back(static_cast<std::uint64_t>(levels));
      combinations *= levels;
    }
    if (std::is_same_v<Levelled, Grid> && combinations > most_trials)
      table_.fault("design",
                   fmt::format("sweep.design = \"grid\" would have {:.3g} trials; at most {:g} are made. Take "
                               "fewer levels or \"latin_hypercube\"",
                               combinations, most_trials));
  }

  TableReader& table_;
  const Study& study_;
  const std::vector<std::optional<double>>& levels_;
};

void read_kept(TableReader& table, Study& study) {
  const std::vector<double> trials = read_list(table, "keep", Presence::optional);
  for (const double trial : trials) {
    if (trial == std::floor(trial) && trial >= 0.0 && trial < static_cast<double>(study.trials())) {
      study.kept.trials.push_back(static_cast<std::uint64_t>(trial));
      continue;
    }
    table.fault("keep",
                fmt::format("sweep.keep names {}, which is no trial; there are 0 to {}", trial, study.trials() - 1));
  }
  const double worst =
      table.number("keep_worst", unit::none, bounds::between(0, 1e4), Presence::optional, "worst trials to be kept")
          .value_or(0.0);
  require_whole(table, "keep_worst", worst);
  study.kept.worst = static_cast<std::uint64_t>(worst);
  study.kept.worst_by = table.text("keep_worst_by").value_or("");
}

}  // namespace

void read_design(TableReader& table, Study& study, const std::vector<std::optional<double>>& levels) {
  study.seed = static_cast<std::uint64_t>(
      table.number("seed", unit::none, seeds, Presence::optional, "seed of all draws").value_or(0.0));
  require_whole(table, "seed", static_cast<double>(study.seed));
  const auto kind = table.choice("design", kinds_of<DesignSettings>(), Presence::required);
  if (!kind) return table.ignore_unknown();  // which keys it may have hangs on its kind
  study.design = make_kind<DesignSettings>(*kind);
  std::visit([&](auto& design) { DesignReader(table, study, levels).read(design); }, study.design);
  if (table.faults().empty()) read_kept(table, study);
  study.referee_tolerance = table
                                .number("referee_tolerance", unit::radian, bounds::positive, Presence::optional,
                                        "difference of the gear angle beyond which the referee disagrees")
                                .value_or(study.referee_tolerance);
  const bool by_levels = !is_sample(study.design);
  for (std::size_t k = 0; k < levels.size(); ++k)
    if (levels[k] && !by_levels)
      table.fault("design", fmt::format("sweep.design = \"{}\" has no levels, and parameter '{}' states some", *kind,
                                        study.parameters[k].path));
  if (!study.copula.independent() && !allows_correlation(study.design))
    table.fault(
        "design",
        fmt::format("sweep.design = \"{}\" needs independent parameters, and there is a [[correlation]]; {}", *kind,
                    by_levels ? "leave it out or take \"monte_carlo\", \"latin_hypercube\" or \"sobol\""
                              : "Sobol indices of dependent parameters do not add up to the variance"));
}

}  // namespace wormdrive
