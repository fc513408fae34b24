#include "sweep/study/read_parameters.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "description/toml/document.hpp"
#include "description/toml/table_reader.hpp"
#include "description/variant_kinds.hpp"

namespace wormdrive {
namespace {

template <class Parametric>
void read_distribution(TableReader& table, Parametric& distribution, DataColumns&) {
  table.read_fields(distribution);
}
void read_distribution(TableReader& table, Discrete& distribution, DataColumns&) {
  distribution.values = read_list(table, "values", Presence::required);
  distribution.weights = read_list(table, "weights", Presence::optional);
}
void read_distribution(TableReader& table, QuantileTable& distribution, DataColumns&) {
  distribution.values = read_list(table, "values", Presence::required);
  distribution.probabilities = read_list(table, "probabilities", Presence::required);
}

void read_distribution(TableReader& table, Empirical& distribution, DataColumns& data) {
  const auto file = table.required_text("file", "a CSV file, relative to the folder of the study");
  const auto column = table.required_text("column", "the column of the file with the values");
  if (!file || !column) return;
  distribution.values = data.read(table, "file", *file, *column);
  std::sort(distribution.values.begin(), distribution.values.end());
}

void read_distribution(TableReader& table, RowOfFile& distribution, DataColumns& data) {
  const auto file = table.required_text("file", "a CSV file, relative to the folder of the study");
  const auto column = table.text("column");
  if (!file) return;
  distribution.file = same_for_one_file(*file);
  distribution.values = data.read(table, "file", *file, column.value_or(table.text("path").value_or("")));
}

StatedParameter read_parameter(TableReader& table, const std::string& name, DataColumns& data, bool in_table) {
  StatedParameter stated{{}, table.where("path"), {}, {}};
  stated.parameter.path = table.required_text("path", "the number that is uncertain, as --set takes it").value_or("");
  if (in_table) {
    stated.column = table.text("column").value_or(stated.parameter.path);
    if (table.has("distribution")) {
      table.fault("distribution",
                  fmt::format("{}.distribution is stated, but sweep.design = \"table\" takes the values "
                              "of a parameter from its file; remove it",
                              name));
      table.ignore_unknown();
    }
    table.finish();
    return stated;
  }
  stated.levels = table.number("levels", unit::whole, bounds::between(1, 1e6), Presence::optional, "levels of a grid");
  const auto kind = table.choice("distribution", kinds_of<Distribution>(), Presence::required);
  if (!kind) {
    table.ignore_unknown();  // which keys it may have hangs on its kind
    return stated;
  }
  stated.parameter.distribution = make_kind<Distribution>(*kind);
  std::visit(
      [&](auto& distribution) {
        read_distribution(table, distribution, data);
        table.finish();
        if (const std::string why = distribution.refusal(); !why.empty() && table.faults().empty())
          table.fault("distribution", fmt::format("{} of '{}': {}", name, stated.parameter.path, why));
      },
      stated.parameter.distribution);
  return stated;
}

}  // namespace

std::vector<double> read_list(TableReader& table, const std::string& key, Presence presence) {
  const auto spelling = table.stated(key, unit::none);
  if (!spelling && presence == Presence::required) table.lacks(fmt::format("'{}'", key));
  return spelling ? table.numbers(*spelling).value_or(std::vector<double>{}) : std::vector<double>{};
}

std::vector<StatedParameter> read_parameters(TableReader& root, DataColumns& data, bool in_table) {
  std::vector<StatedParameter> list;
  const std::vector<const toml::table*> tables = root.tables("parameter");
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const std::string name = fmt::format("parameter[{}]", k);
    TableReader table(tables[k], name, root.axis(), root.faults(), root.where());
    list.push_back(read_parameter(table, name, data, in_table));
  }
  if (!root.has("parameter")) root.lacks("a [[parameter]] to vary");
  return list;
}

Copula read_correlations(TableReader& root, const std::vector<StatedParameter>& parameters) {
  const std::vector<const toml::table*> tables = root.tables("correlation");
  if (tables.empty()) return {};
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(count, count);
  std::map<std::pair<Eigen::Index, Eigen::Index>, std::size_t> stated;  // pairs, and the table of each
  for (std::size_t k = 0; k < tables.size(); ++k) {
    TableReader table(tables[k], fmt::format("correlation[{}]", k), root.axis(), root.faults(), root.where());
    const std::vector<std::string> between = table.texts("between");
    const double coefficient =
        table.number("coefficient", unit::none, bounds::open(-1, 1), Presence::required, "correlation of normal scores")
            .value_or(0.0);
    std::vector<Eigen::Index> pair;
    for (const std::string& path : between) {
      const auto found = std::find_if(parameters.begin(), parameters.end(),
                                      [&](const StatedParameter& p) { return p.parameter.path == path; });
      if (found == parameters.end())
        table.fault(
            "between",
            fmt::format("correlation[{}].between names '{}', which is not the path of a [[parameter]]", k, path));
      else if (std::holds_alternative<RowOfFile>(found->parameter.distribution))
        table.fault("between", fmt::format("correlation[{}].between names '{}', which is drawn by rows of a file; the "
                                           "rows have its correlations",
                                           k, path));
      else
        pair.push_back(found - parameters.begin());
    }
    if (between.size() != 2 || (pair.size() == 2 && pair[0] == pair[1])) {
      table.fault("between", fmt::format("correlation[{}].between must name two parameters", k));
    } else if (pair.size() == 2) {
      if (const auto [before, is_new] = stated.try_emplace(std::minmax(pair[0], pair[1]), k); !is_new)
        table.fault("between", fmt::format("correlation[{}].between names '{}' and '{}', as correlation[{}] does; keep "
                                           "one of them",
                                           k, between[0], between[1], before->second));
      matrix(pair[0], pair[1]) = matrix(pair[1], pair[0]) = coefficient;
    }
    table.finish();
  }
  if (!root.faults().empty()) return {};
  if (!Copula::exists(matrix)) {
    root.fault(
        "correlation",
        "these correlations contradict each other: their matrix is not positive definite; bring them closer to 0");
    return {};
  }
  return Copula(matrix);
}

}  // namespace wormdrive
