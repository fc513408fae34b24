#include "sweep/order_statistics.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace wormdrive {
namespace {

constexpr int digit = 11;  ///< bits by which values are told apart in one pass
constexpr std::uint64_t sign = std::uint64_t{1} << 63;

/// A whole number that rises with the value, and back.
std::uint64_t key(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}
double value_of(std::uint64_t key) { return std::bit_cast<double>((key & sign) != 0 ? key & ~sign : ~key); }

/// Values whose keys begin alike, and the ranks that are wanted of them.
struct Bucket {
  std::uint64_t prefix;
  std::uint64_t before;  ///< values that are less
  std::vector<std::uint64_t> ranks;
  std::vector<std::uint64_t> counts;  ///< by the next digit
};

/// Counts the values of every bucket by the next digit; left: bits of a key behind the prefix.
void count(const Column& column, std::vector<Bucket>& buckets, int left, int width) {
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  for (Bucket& bucket : buckets) bucket.counts.assign(mask + 1, 0);
  column([&](std::span<const double> values) {
    for (const double value : values) {
      const std::uint64_t k = key(value), prefix = left == 64 ? 0 : k >> left;
      const auto bucket = std::lower_bound(buckets.begin(), buckets.end(), prefix,
                                           [](const Bucket& b, std::uint64_t p) { return b.prefix < p; });
      if (bucket != buckets.end() && bucket->prefix == prefix) ++bucket->counts[(k >> (left - width)) & mask];
    }
  });
}

/// The buckets of one digit more that hold a wanted rank, in rising order.
std::vector<Bucket> narrowed(const std::vector<Bucket>& buckets, int width) {
  std::vector<Bucket> narrow;
  for (const Bucket& bucket : buckets) {
    std::uint64_t before = bucket.before, next = 0;
    for (const std::uint64_t rank : bucket.ranks) {
      while (before + bucket.counts[next] <= rank) before += bucket.counts[next++];
      const std::uint64_t prefix = bucket.prefix << width | next;
      if (narrow.empty() || narrow.back().prefix != prefix) narrow.push_back({prefix, before, {}, {}});
      narrow.back().ranks.push_back(rank);
    }
  }
  return narrow;
}

}  // namespace

std::map<std::uint64_t, double> order_statistics(const Column& column, const std::set<std::uint64_t>& ranks) {
  std::vector<Bucket> buckets{{0, 0, {ranks.begin(), ranks.end()}, {}}};
  for (int left = 64; left > 0 && !ranks.empty();) {
    const int width = std::min(left, digit);
    count(column, buckets, left, width);
    buckets = narrowed(buckets, width);
    left -= width;
  }
  std::map<std::uint64_t, double> found;
  for (const Bucket& bucket : buckets)
    for (const std::uint64_t rank : bucket.ranks) found[rank] = value_of(bucket.prefix);
  return found;
}

}  // namespace wormdrive
