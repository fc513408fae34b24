#pragma once
#include <variant>
#include <vector>

#include "control/references/chirp.hpp"
#include "control/references/multisine.hpp"
#include "control/references/random_steps.hpp"
#include "control/references/sinusoid.hpp"
#include "control/references/step.hpp"
#include "control/references/table.hpp"
#include "control/references/trapezoid.hpp"

namespace wormdrive {

/// Every kind of reference trajectory; a new one is a new file and one entry here.
using ReferenceTerm = std::variant<SinusoidReference, StepReference, TrapezoidReference, ChirpReference,
                                   MultisineReference, RandomStepsReference, TableReference>;

/// The motion that is asked for: the sum of its terms.
struct Reference {
  std::vector<ReferenceTerm> terms;

  bool operator==(const Reference&) const = default;

  ReferencePoint at(double t) const {
    ReferencePoint sum;
    for (const ReferenceTerm& term : terms) {
      const auto* sine = std::get_if<SinusoidReference>(&term);  // most are one: no jump through a table
      sum += sine ? sine->at(t) : any(term, t);
    }
    return sum;
  }

 private:
  [[gnu::noinline]] static ReferencePoint any(const ReferenceTerm& term, double t) {
    return std::visit([&](const auto& r) { return r.at(t); }, term);
  }
};

}  // namespace wormdrive
