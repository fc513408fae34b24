#pragma once
#include "events/taylor/tapes/series.hpp"

// What the operations on a tape do. Included where they are compiled: for a drive alone, and for each kind of lanes.

namespace wormdrive {
namespace tape_operations {

template <class V>
[[gnu::always_inline]] inline V product(const V* a, const V* b, int k) {
  V sum = a[0] * b[k];
  for (int j = 1; j <= k; ++j) sum += a[j] * b[k - j];
  return sum;
}
/// Coefficient k - 1 of a' b, times k. slope: its coefficients j a[j].
template <class V>
[[gnu::always_inline]] inline V chain(const V* slope, const V* b, int k) {
  V sum = 0.0;
  for (int j = 1; j <= k; ++j) sum += slope[j] * b[k - j];
  return sum;
}
}  // namespace tape_operations

template <class V>
template <class Functions>
void TapeSeriesOf<V>::work_out(int k, int operations, Functions&& functions) {
  using Operation = Tape::Operation;
  using namespace tape_operations;
  const double share = 1.0 / static_cast<double>(k);
  int section = 0;
  const LineOf<V>* line = lines_;
  const Tape::Step* step = code_->steps;
  for (const Tape::Step* const end = step + operations; step != end; ++step, ++line) {
    const V* const a = (*this)[step->a];
    const V* const b = (*this)[step->b];
    V* const r = (*this)[step->result];
    switch (step->operation) {
      case Operation::combine: {
        const V sum = line->factor * a[k] + line->second * b[k];
        r[k] = k == 0 ? sum + line->offset : sum;
        break;
      }
      case Operation::multiply: r[k] = product(a, b, k); break;
      case Operation::affine: r[k] = k == 0 ? line->factor * a[0] + line->offset : line->factor * a[k]; break;
      case Operation::divide:
      case Operation::invert: {
        const bool inverts = step->operation == Operation::invert;
        const V* const divisor = inverts ? a : b;
        V rest = !inverts ? a[k] : k == 0 ? line->factor : V(0.0);
        for (int j = 0; j < k; ++j) rest = rest - r[j] * divisor[k - j];
        r[k] = rest / divisor[0];
        break;
      }
      case Operation::sine_cosine: {
        V *const cosine = (*this)[step->result + 1], *const slope = (*this)[step->result + 2];
        slope[k] = static_cast<double>(k) * a[k];
        if (k == 0) {
          const SineAndCosineOf<V> start = functions.sine_and_cosine(a[0]);
          r[0] = start.sine;
          cosine[0] = start.cosine;
        } else {
          const V rises = chain(slope, cosine, k), falls = chain(slope, r, k);
          r[k] = rises * share;
          cosine[k] = -falls * share;
        }
        break;
      }
      case Operation::exponential: {
        V* const slope = (*this)[step->result + 1];
        slope[k] = static_cast<double>(k) * a[k];
        r[k] = k == 0 ? functions.exp(a[0]) : chain(slope, r, k) * share;
        break;
      }
      case Operation::square_root: {
        V rest = a[k];
        for (int j = 1; j < k; ++j) rest = rest - r[j] * r[k - j];
        r[k] = k == 0 ? root(a[0]) : rest / (2.0 * r[0]);
        break;
      }
      case Operation::table: {
        if (k == 0) functions.find(section, a[0]);
        const bool turned = k > 0 && functions.turns(section, a, k);
        const SectionOf<V>& c = sections_[section++];
        V* const mean = (*this)[step->result + 1];  // what the outer bracket comes to
        const V s = a[0] - c.begin, inner = c.second + s * c.third;
        if (k == 0) {
          mean[0] = c.slope + s * inner;
          r[0] = c.value + s * mean[0];
        } else {
          if (turned) mean[0] = c.slope + s * inner;  // value and slope of the table, and so r[0], are the same
          V bracket = a[k] * inner + s * (c.third * a[k]), result = a[k] * mean[0];
          for (int j = 1; j < k; ++j) bracket += a[j] * (c.third * a[k - j]);
          mean[k] = bracket;
          for (int j = 1; j < k; ++j) result += a[j] * mean[k - j];
          r[k] = result + s * bracket;
        }
        break;
      }
    }
  }
}

}  // namespace wormdrive
