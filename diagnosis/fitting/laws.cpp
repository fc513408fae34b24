#include "diagnosis/fitting/laws.hpp"

#include <algorithm>

#include "diagnosis/fitting/fit.hpp"
#include "statistics/parallel.hpp"

namespace wormdrive {

namespace {

/// What is chosen in one of a candidate's laws.
using Law = std::vector<FieldValue>;

bool follows(const RecordedDrive& drive, const Law& law) {
  return std::all_of(law.begin(), law.end(),
                     [&](const FieldValue& f) { return field_of(drive, f.effect, f.field).value == f.value; });
}

Hypothesis with_law(Hypothesis h, const Law& law) {
  for (const FieldValue& f : law) set_field(h.drive, f);
  return h;
}

}  // namespace

void try_other_laws(const Evaluation& evaluation, Hypothesis& h, const Candidate& candidate) {
  if (!candidate.finite) return;  // else a start is as good as a fit
  std::vector<Hypothesis> others;
  for (const CandidateStart& start : candidate.starts)
    if (!follows(h.drive, start.chosen) && std::none_of(others.begin(), others.end(), [&](const Hypothesis& known) {
          return follows(known.drive, start.chosen);
        }))
      others.push_back(with_law(h, start.chosen));
  parallel_for(others.size(), evaluation.threads(), [&](std::size_t k) { fit(evaluation, others[k], 8, 0.5); });
  for (Hypothesis& other : others)
    if (other.bic < h.bic) h = std::move(other);
}

}  // namespace wormdrive
