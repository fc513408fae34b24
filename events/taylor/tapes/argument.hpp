#pragma once
#include "core/numbers/lanes.hpp"
#include "events/taylor/terms.hpp"

namespace wormdrive {

/// The argument of a table over a length of time: its terms there, and what they come to.
template <class V, int longest>
struct ArgumentOf {
  V terms[longest];
  int count;
  V moves = 0.0;  ///< how far it gets
  V bends = 0.0;  ///< what all terms but the first may add to that ...
  V turns = 0.0;  ///< ... and to the first one's slope, times the length

  /// c: its coefficients, of which a drive alone would have so many.
  ArgumentOf(const V* c, const TermsOf<V>& of, const V& length) : count(of.most) {
    terms[0] = c[0];
    V power = length;
    for (int k = 1; k < count; ++k, power = power * length) {
      const V term = select(V(static_cast<double>(k)) < of.of_each, c[k] * power, V(0.0));
      terms[k] = term;
      moves += term;
      if (k == 1) continue;
      bends += abs(term);
      turns += static_cast<double>(k) * abs(term);
    }
  }

  /// By how many shares of the length a share is beyond that at which it has moved to the target, to first order.
  V beyond(const V& target, const V& share) const {
    V sum = 0.0, slope = 0.0;
    for (int k = count - 1; k >= 1; --k) {
      sum = (sum + terms[k]) * share;
      slope = slope * share + static_cast<double>(k) * terms[k];
    }
    return (sum - target) / slope;
  }
};

}  // namespace wormdrive
