#pragma once
#include "events/taylor/tapes/series.hpp"

// What the operations on a tape do. Included where they are compiled: for a drive alone, and for each kind of lanes.

namespace wormdrive {
namespace tape_operations {

/// Bounds of cosh r - 1 and sinh r up to the widest disc: series whose last term makes up for the rest.
template <class V>
struct Growth {
  V cosh_less_1, sinh;

  [[gnu::always_inline]] explicit Growth(const V& r) {
    const V w = r * r;
    cosh_less_1 = 0.5 * w * (1.0 + w * (1.0 / 12) * (1.0 + w * (1.0 / 30) * (1.0 + w * (1.1 / 56))));
    sinh = r * (1.0 + w * (1.0 / 6) * (1.0 + w * (1.0 / 20) * (1.0 + w * (1.1 / 42))));
  }
};

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
/// Lengths of a section of a table within which the disc of an argument stays: its cubic holds for all arguments, but
/// grows fast beyond the section, and a leap ends where that does.
inline constexpr double sections_seen = 4.0;

/// The disc of the cubic of a table; where that of its argument has to be smaller, one that shrinks with it.
template <class V>
[[gnu::always_inline]] inline V disc(const SectionOf<V>& c, const V& x, const V& radius) {
  const V seen = least<V>(radius, sections_seen * (c.high - c.low));
  const V s = x - c.begin, slope = c.slope + s * (2.0 * c.second + s * 3.0 * c.third);
  const V bend = c.second + 3.0 * s * c.third;
  return radius * (abs(slope) + seen * (abs(bend) + seen * abs(c.third)));
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

template <class V>
void TapeSeriesOf<V>::work_out_discs() {
  using Operation = Tape::Operation;
  using namespace tape_operations;
  const auto size = [this](int place) { return abs((*this)[place][0]); };
  const SectionOf<V>* section = sections_;
  const LineOf<V>* line = lines_;
  const Tape::Step* s = code_->steps;
  for (const Tape::Step* const end = s + code_->operations; s != end; ++s, ++line) {
    const V ra = radius(s->a), rb = radius(s->b);
    V& r = radius(s->result);
    switch (s->operation) {
      case Operation::combine: r = abs(line->factor) * ra + abs(line->second) * rb; break;
      case Operation::multiply: r = size(s->a) * rb + ra * (size(s->b) + rb); break;
      case Operation::affine: r = abs(line->factor) * ra; break;
      case Operation::divide:
      case Operation::invert: {
        const bool inverts = s->operation == Operation::invert;
        const V divisor = size(inverts ? s->a : s->b), nearest = divisor - (inverts ? ra : rb);
        const V strays = size(s->result) * (inverts ? ra : rb) + (inverts ? V(0.0) : ra);
        r = strays / greatest<V>(nearest, 0.5 * divisor);
        break;
      }
      case Operation::sine_cosine: {
        const Growth<V> grows(ra);
        const V sine = size(s->result), cosine = size(s->result + 1);
        r = cosine * grows.sinh + sine * grows.cosh_less_1;
        radius(s->result + 1) = sine * grows.sinh + cosine * grows.cosh_less_1;
        break;
      }
      case Operation::exponential: {
        const Growth<V> grows(ra);
        r = (*this)[s->result][0] * (grows.sinh + grows.cosh_less_1);
        break;
      }
      case Operation::square_root: r = ra / (*this)[s->result][0]; break;  // |sqrt(x + z) - sqrt(x)| <= |z|/sqrt(x)
      case Operation::table: r = disc(*section++, (*this)[s->a][0], ra); break;
    }
  }
}

template <class V>
V TapeSeriesOf<V>::shrinking() const {
  using Operation = Tape::Operation;
  V factor = 1.0;
  const auto within = [&](const V& radius, const V& most) {
    const Mask beyond = radius > most;
    if (any(beyond)) factor = select(beyond, least<V>(factor, most / radius), factor);
  };
  const auto half = [this](int place) { return 0.5 * abs((*this)[place][0]); };
  const SectionOf<V>* section = sections_;
  const Tape::Step* s = code_->steps;
  for (const Tape::Step* const end = s + code_->operations; s != end; ++s) switch (s->operation) {
      case Operation::sine_cosine: within(radius(s->a), V(widest)); break;
      case Operation::exponential: within(radius(s->a), V(0.5 * widest)); break;
      case Operation::square_root:
      case Operation::invert: within(radius(s->a), half(s->a)); break;
      case Operation::divide: within(radius(s->b), half(s->b)); break;
      case Operation::table:
        within(radius(s->a), tape_operations::sections_seen * (section->high - section->low));
        ++section;
        break;
      case Operation::combine:
      case Operation::multiply:
      case Operation::affine: break;
    }
  return factor;
}

template <class V>
auto TapeSeriesOf<V>::stays_in_range(const V& share) const -> Mask {
  Mask stays = share >= V(0.0);
  for (int k = 0; k < code_->bounds; ++k) {
    const int place = code_->bounded[k];
    stays = stays & ((*this)[place][0] - radius(place) * share > least_[k]);
  }
  return stays;
}

}  // namespace wormdrive
