#include "recovery/tables.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "statistics/robust.hpp"

namespace recovery {
namespace {

/// P(X <= k) of a binomial.
double binomial_at_most(long k, long n, double p) {
  double sum = 0.0;
  for (long j = 0; j <= k; ++j)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(j + 1.0) - std::lgamma(n - j + 1.0) +
                    (j > 0 ? static_cast<double>(j) * std::log(p) : 0.0) +
                    (n > j ? static_cast<double>(n - j) * std::log1p(-p) : 0.0));
  return sum;
}

double median(const std::vector<double>& values) { return values.empty() ? std::nan("") : wormdrive::median(values); }

std::string hidden(const Outcome& outcome) {
  std::vector<std::string> parts;
  for (const Hiding& h : outcome.drawn.hidden) parts.emplace_back(h.secret->effect);
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, " + "));
}

std::vector<Outcome> of_size(const std::vector<Outcome>& outcomes, truth::Size size) {
  std::vector<Outcome> kept;
  for (const Outcome& o : outcomes)
    if (!o.drawn.hidden.empty() && o.drawn.hidden.front().size == size) kept.push_back(o);
  return kept;
}

std::string share(const Coverage& c) {
  return c.intervals == 0
             ? "-"
             : fmt::format("{:.0f} % of {}", 100.0 * static_cast<double>(c.holding) / static_cast<double>(c.intervals),
                           c.intervals);
}

std::string score_row(const std::string& title, const std::vector<Outcome>& outcomes) {
  std::string row = fmt::format("| {} | {} |", title, outcomes.size());
  for (const Score score : scores) row += fmt::format(" {} |", count(outcomes, score));
  const auto flagged = std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.flagged; });
  std::vector<double> errors, held_out, sizes;
  Coverage causes, calibrated;
  for (const Outcome& o : outcomes) {
    errors.insert(errors.end(), o.errors.begin(), o.errors.end());
    causes += o.causes;
    calibrated += o.calibrated;
    if (o.held_out > 0.0) held_out.push_back(o.held_out);
    sizes.push_back(static_cast<double>(o.class_size));
  }
  double mean_class = 0.0;
  for (const double size : sizes) mean_class += size / static_cast<double>(sizes.size());
  const auto shown = [](double x, double factor, const char* unit) {
    return std::isnan(x) ? std::string("-") : fmt::format("{:.2g}{}", factor * x, unit);
  };
  row += fmt::format(" {} | {:.2f} | {} | {} | {} | {} |\n", flagged, mean_class, shown(median(errors), 100.0, " %"),
                     share(causes), share(calibrated), shown(median(held_out), 1.0, ""));
  return row;
}

}  // namespace

std::string answer(const Outcome& outcome) {
  if (outcome.score == Score::crash) return "crash";
  if (outcome.named.empty()) return outcome.flagged ? "unexplained" : "adequate";
  return fmt::format("{}{}", fmt::join(outcome.named, " + "), outcome.flagged ? ", in part" : "");
}

long count(const std::vector<Outcome>& outcomes, Score score) {
  return std::count_if(outcomes.begin(), outcomes.end(), [&](const Outcome& o) { return o.score == score; });
}

long least_successes(long n, double p, double tail) {
  long k = 0;
  while (k < n && binomial_at_most(k, n, p) < tail) ++k;
  return k;
}

double rate_at_most(long k, long n) {
  double low = 0.0, high = 1.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (binomial_at_most(k, n, middle) > 0.05 ? low : high) = middle;
  }
  return high;
}

std::string tables(const Plan& plan, const std::vector<Outcome>& outcomes) {
  std::string text = fmt::format("### Hidden: {}; conditions: {}\n\n{} recordings of {}, seed {}{}.\n\n",
                                 name(plan.kind), plan.conditions.name, outcomes.size(),
                                 plan.any_bench ? "any bench" : fmt::format("{:g} s", plan.duration), plan.seed,
                                 plan.conditions.worm_counts > 0.0 ? ", with an encoder on the worm" : "");
  text += "| size | n |";
  for (const Score score : scores) text += fmt::format(" {} |", name(score));
  text += " flagged | class | error | covered | calibrated | held out |\n|---|---|";
  for (std::size_t k = 0; k < std::size(scores) + 6; ++k) text += "---|";
  text += "\n";
  for (const truth::Size size : truth::sizes)
    if (const auto some = of_size(outcomes, size); !some.empty()) text += score_row(std::string(name(size)), some);
  text += score_row("all", outcomes);
  if (plan.kind != Kind::nothing && plan.kind != Kind::outside) {
    std::vector<Outcome> observable;
    std::copy_if(outcomes.begin(), outcomes.end(), std::back_inserter(observable),
                 [](const Outcome& o) { return o.observable; });
    text += score_row("observable", observable);
  }
  if (plan.kind == Kind::nothing) {
    const long named = count(outcomes, Score::wrong);  // a number that is off was named rightly
    const long alarms = std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.flagged; });
    const auto n = static_cast<long>(outcomes.size());
    text += fmt::format("\nFalse names: {} of {}; the rate is at most {:.1f} % (95 %). Alarms: {}; at most {:.1f} %.\n",
                        named, n, 100.0 * rate_at_most(named, n), alarms, 100.0 * rate_at_most(alarms, n));
  }
  if (plan.kind == Kind::outside) {
    const auto honest = std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) {
      return o.score == Score::exact || (o.flagged && o.score != Score::crash);
    });
    std::vector<double> improved;
    for (const Outcome& o : outcomes)
      if (o.flagged && o.improved > 0.0) improved.push_back(o.improved);
    text += fmt::format(
        "\nReported as unexplained, or `dwell` named as `static_friction`: {} of {}. Error 0.25 s ahead "
        "with what was learned over that of the stated drive, median of those reported: {:.2g}.\n",
        honest, outcomes.size(), median(improved));
  }
  std::map<std::string, std::map<std::string, long>> confusion;
  for (const Outcome& o : outcomes)
    if (o.score != Score::exact) ++confusion[hidden(o)][answer(o)];
  if (!confusion.empty()) text += "\n| hidden | answers that are not exact |\n|---|---|\n";
  for (const auto& [what, answers] : confusion) {
    std::vector<std::string> parts;
    for (const auto& [said, times] : answers) parts.push_back(times > 1 ? fmt::format("{} ({})", said, times) : said);
    text += fmt::format("| {} | {} |\n", what, fmt::join(parts, "; "));
  }
  std::vector<double> seconds;
  for (const Outcome& o : outcomes) seconds.push_back(o.seconds);
  return text + fmt::format("\nMedian time of a diagnosis: {:.1f} s.\n\n", median(seconds));
}

std::string line(const Outcome& outcome) {
  std::vector<std::string> parts;
  for (const Hiding& h : outcome.drawn.hidden)
    parts.push_back(fmt::format("{} {:+.3g} ({})", h.secret->effect, h.amount, name(h.size)));
  return fmt::format("{:20} {:45} {:8} {:40} class {} errors [{:.1e}] deviations [{:.1f}] {:.1f} s  {}",
                     outcome.drawn.seed, fmt::format("{}", fmt::join(parts, ", ")), name(outcome.score),
                     answer(outcome), outcome.class_size, fmt::join(outcome.errors, ", "),
                     fmt::join(outcome.deviations, ", "), outcome.seconds,
                     outcome.score == Score::crash ? outcome.told
                     : outcome.observable          ? ""
                                                   : "below the certificate");
}

}  // namespace recovery
