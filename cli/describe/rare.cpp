#include "cli/describe/rare.hpp"

#include <fmt/format.h>

namespace wormdrive {

std::string in_words(const RareEstimate& p) {
  return fmt::format("{:.3g} [{:.3g}, {:.3g}] (95 % interval)", p.probability, p.low, p.high);
}

std::string verdict_on(const RareEvent& event) {
  if (event.median_misses) return "the median drive misses the limit: a miss is not rare, and plain sampling serves";
  if (!event.design.converged)
    return "there is no design point that samples could be drawn around; the subset simulation stands";
  if (event.agrees()) return "the two intervals overlap";
  return "the two intervals do not overlap: drives miss in other ways than at the design point, which samples around "
         "it do not see; the subset simulation stands";
}

}  // namespace wormdrive
