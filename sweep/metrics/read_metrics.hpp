#pragma once
#include <vector>

#include "description/toml/table_reader.hpp"
#include "sweep/metrics/metric.hpp"
#include "sweep/metrics/own_metric.hpp"

namespace wormdrive {

/// Reads every [[metric]] of a study. taken: names that are not free.
std::vector<OwnMetric> read_own_metrics(TableReader& root, const Scenario& scenario,
                                        const std::vector<std::string>& taken);

/// The own metric at a place in the list of a study, as one of its metrics.
Metric as_metric(const std::vector<OwnMetric>& own, std::size_t place);

}  // namespace wormdrive
