#include "sweep/study/read_design.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "description/toml/table_reader.hpp"
#include "description/variant_kinds.hpp"
#include "statistics/random.hpp"

namespace wormdrive {
namespace {

constexpr double most_trials = 1e12;  ///< whoever asks for more has slipped

std::uint64_t whole(TableReader& table, const std::string& key, const Bounds& bounds, std::string_view meaning) {
  return static_cast<std::uint64_t>(table.number(key, unit::whole, bounds, Presence::required, meaning).value_or(1.0));
}

class DesignReader {
 public:
  DesignReader(TableReader& table, Study& study, const std::vector<StatedParameter>& stated, DataColumns& data)
      : table_(table), study_(study), stated_(stated), data_(data) {}

  void read(MonteCarlo& design) { read_trials(design); }
  void read(LatinHypercube& design) { read_trials(design); }
  void read(SobolSequence& design) { read_trials(design); }
  void read(Saltelli& design) {
    design.samples = whole(table_, "samples", bounds::between(2, most_trials / 1e4),
                           "rows of each of the two samples; there are samples (parameters + 2) trials");
    design.second_order = table_.truth("second_order").value_or(false);
  }
  void read(Shapley& design) {
    design.permutations = whole(table_, "permutations", bounds::between(2, most_trials / 1e4),
                                "random orders of the parameters; there are permutations (parameters + 1) trials");
    design.copula = study_.copula;
  }
  void read(Morris& design) {
    design.trajectories = whole(table_, "trajectories", bounds::between(2, most_trials / 1e4),
                                "elementary effects of each parameter; there are trajectories (parameters + 1) trials");
    constexpr double usual = 4.0;  // [Morris1991], and SALib after it
    const double levels =
        table_.number("levels", unit::none, bounds::between(2, 1e6), Presence::optional, "levels of each parameter")
            .value_or(usual);
    if (std::fmod(levels, 2.0) != 0.0)
      table_.fault("levels",
                   fmt::format("sweep.levels = {} must be even, for a parameter changes by half of them", levels));
    design.levels = static_cast<std::uint64_t>(levels);
  }
  void read(Grid& design) { read_levels(design); }
  void read(OneAtATime& design) { read_levels(design); }
  void read(TableOfPoints& design) {
    const auto file = table_.required_text(
        "file", "a CSV file with a column for each parameter, relative to the folder of the study");
    for (std::size_t k = 0; file && k < stated_.size(); ++k) {
      Discrete column{data_.read(table_, "file", *file, stated_[k].column), {}};
      design.trials = column.values.size();
      study_.parameters[k].distribution = std::move(column);
    }
  }

 private:
  template <class Sampled>
  void read_trials(Sampled& design) {
    design.trials = whole(table_, "trials", bounds::between(1, most_trials), "number of trials");
  }

  template <class Levelled>
  void read_levels(Levelled& design) {
    const Bounds range = bounds::between(1, 1e6);
    const auto common = table_.number("levels", unit::whole, range, Presence::optional, "levels of each parameter");
    double combinations = 1.0;
    for (std::size_t k = 0; k < stated_.size(); ++k) {
      UncertainParameter& parameter = study_.parameters[k];
      double levels = stated_[k].levels.value_or(common.value_or(5.0)), median = 0.5;
      if (auto* const discrete = std::get_if<Discrete>(&parameter.distribution)) {
        const double at_median = discrete->quantile(0.5);
        *discrete = discrete->each_once();
        const std::vector<double>& values = discrete->values;
        if (stated_[k].levels.value_or(static_cast<double>(values.size())) != static_cast<double>(values.size()))
          table_.fault("design",
                       fmt::format("sweep.design = \"{}\" takes every value of a discrete parameter once, but "
                                   "'{}' has {} values but states levels = {}; remove them",
                                   Levelled::kind, parameter.path, values.size(), levels));
        levels = static_cast<double>(values.size());
        const auto place = std::find(values.begin(), values.end(), at_median) - values.begin();
        median = middle_of(static_cast<std::uint64_t>(place), values.size());
      }
      design.levels.push_back(static_cast<std::uint64_t>(levels));
      if constexpr (std::is_same_v<Levelled, OneAtATime>) design.medians.push_back(median);
      combinations *= levels;
    }
    if (std::is_same_v<Levelled, Grid> && combinations > most_trials)
      table_.fault("design",
                   fmt::format("sweep.design = \"grid\" would have {:.3g} trials; at most {:g} are allowed. Use "
                               "fewer levels or \"latin_hypercube\"",
                               combinations, most_trials));
  }

  TableReader& table_;
  Study& study_;
  const std::vector<StatedParameter>& stated_;
  DataColumns& data_;
};

void read_kept(TableReader& table, Study& study) {
  const std::vector<double> trials = read_list(table, "keep", Presence::optional);
  for (const double trial : trials) {
    if (trial == std::floor(trial) && trial >= 0.0 && trial < static_cast<double>(study.trials())) {
      study.kept.trials.push_back(static_cast<std::uint64_t>(trial));
      continue;
    }
    table.fault("keep", fmt::format("sweep.keep names trial {}, which does not exist; the trials are 0 to {}", trial,
                                    study.trials() - 1));
  }
  study.kept.worst = static_cast<std::uint64_t>(
      table.number("keep_worst", unit::whole, bounds::between(0, 1e4), Presence::optional, "worst trials to be kept")
          .value_or(0.0));
  study.kept.worst_by = table.text("keep_worst_by").value_or("");
}

}  // namespace

void read_design(TableReader& table, Study& study, const std::vector<StatedParameter>& stated, DataColumns& data) {
  study.seed = static_cast<std::uint64_t>(
      table.number("seed", unit::whole, seeds, Presence::optional, "seed of all draws").value_or(0.0));
  study.common_random_numbers = table.truth("common_random_numbers").value_or(false);
  const auto kind = table.choice("design", kinds_of<DesignSettings>(), Presence::required);
  if (!kind) return table.ignore_unknown();  // which keys it may have hangs on its kind
  study.design = make_kind<DesignSettings>(*kind);
  std::visit([&](auto& design) { DesignReader(table, study, stated, data).read(design); }, study.design);
  if (table.faults().empty()) read_kept(table, study);
  study.referee_tolerance = table
                                .number("referee_tolerance", unit::radian, bounds::positive, Presence::optional,
                                        "difference of the gear angle beyond which the referee disagrees")
                                .value_or(study.referee_tolerance);
  for (std::size_t k = 0; k < stated.size(); ++k)
    if (stated[k].levels && !goes_by_levels(study.design))
      table.fault("design", fmt::format("sweep.design = \"{}\" has no levels of single parameters, but parameter '{}' "
                                        "states some",
                                        *kind, study.parameters[k].path));
  if (!study.copula.independent() && !allows_correlation(study.design))
    table.fault(
        "design",
        fmt::format("sweep.design = \"{}\" needs independent parameters, but there is a [[correlation]]; {}", *kind,
                    is_sample(study.design)
                        ? "Sobol indices of dependent parameters do not add up to the variance; use \"shapley\""
                        : "remove it or use \"monte_carlo\", \"latin_hypercube\" or \"sobol\""));
  if (const UncertainParameter* const drawn = study.drawn_by_rows(); drawn && !draws_each_trial(study.design))
    table.fault("design", fmt::format("sweep.design = \"{}\" needs parameters that can change one by one, but '{}' is "
                                      "drawn by rows of a file; use \"monte_carlo\", \"latin_hypercube\" or "
                                      "\"sobol\"",
                                      *kind, drawn->path));
  const auto* const latin = std::get_if<LatinHypercube>(&study.design);
  if (!latin || study.copula.independent() || !table.faults().empty()) return;
  if (latin->trials > CorrelatedStrata::most_trials)
    table.fault("trials",
                fmt::format("sweep.trials = {} is too many for a Latin hypercube with a [[correlation]], which "
                            "is held in memory; at most {} are allowed, or use \"sobol\" or \"monte_carlo\"",
                            latin->trials, CorrelatedStrata::most_trials));
  study.strata = std::make_shared<CorrelatedStrata>(latin->trials, study.copula, study.seed);
}

}  // namespace wormdrive
