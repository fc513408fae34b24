#pragma once
#include "core/numbers/lanes.hpp"
#include "events/taylor/polynomial.hpp"

namespace wormdrive {

inline constexpr double above_one = 1.000001;  ///< what rounding could add to a bound

/// How many coefficients of an acceleration a step needs, of one drive or of several at once, and the most of all.
template <class V>
struct TermsOf {
  V of_each;
  int most = 0;
  MaskOf<V> suffice;  ///< where that many do
  int fewest = 0;     ///< of any that counts

  /// Among some, where `first` leave an error of the acceleration that falls by a ratio with each one more.
  [[gnu::always_inline]] static TermsOf needed(const MaskOf<V>& among, int first, int longest, V error, const V& ratio,
                                               const V& allowed) {
    TermsOf terms{V(0.0), 0, among};
    MaskOf<V> left = among;
    for (int n = first; n <= longest && any(left); ++n, error = error * ratio) {
      const MaskOf<V> enough = left & (error * one_over(n + 1) <= allowed);
      if (!any(enough)) continue;
      if (terms.fewest == 0) terms.fewest = n;
      terms.of_each = select(enough, V(static_cast<double>(n)), terms.of_each);
      terms.most = n;
      left = left & !enough;
    }
    if (terms.fewest == 0) terms.fewest = terms.most;
    terms.suffice = among & !left;
    return terms;
  }
};

}  // namespace wormdrive
