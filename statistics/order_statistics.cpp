#include "statistics/order_statistics.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>
#include <vector>

namespace wormdrive {
namespace {

constexpr int digit = 11;                        ///< bits by which values are told apart in one pass
constexpr std::uint64_t held_at_once = 1 << 16;  ///< values
constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;

/// A whole number that rises with the value.
std::uint64_t key(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & sign_bit) != 0 ? ~bits : bits | sign_bit;
}
/// Values whose keys begin alike, and the ranks that are wanted of them.
struct Bucket {
  std::uint64_t prefix;
  std::uint64_t before;  ///< values that are less
  std::uint64_t size;
  std::vector<std::uint64_t> ranks;
  std::vector<std::uint64_t> counts{};  ///< by the next digit
  std::vector<double> values{};
};

std::uint64_t size(const std::vector<Bucket>& buckets) {
  return std::accumulate(buckets.begin(), buckets.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Bucket& bucket) { return sum + bucket.size; });
}

/// The first bits of a key, less so many.
std::uint64_t prefix_of(std::uint64_t key, int left) { return left == 64 ? 0 : key >> left; }

/// Calls visit(bucket, value, key) for every value that lies in one; left: bits of a key behind the prefix.
template <class Visit>
void for_each_value(const Column& column, std::vector<Bucket>& buckets, int left, Visit&& visit) {
  constexpr std::uint64_t last_digit = (std::uint64_t{1} << digit) - 1;
  std::array<bool, last_digit + 1> ends_a_prefix{};  // most values lie in no bucket: this tells of nearly all of them
  for (const Bucket& bucket : buckets) ends_a_prefix[bucket.prefix & last_digit] = true;
  column([&](std::span<const double> values) {
    for (const double value : values) {
      const std::uint64_t k = key(value), prefix = prefix_of(k, left);
      if (!ends_a_prefix[prefix & last_digit]) continue;
      const auto bucket = std::lower_bound(buckets.begin(), buckets.end(), prefix,
                                           [](const Bucket& b, std::uint64_t p) { return b.prefix < p; });
      if (bucket != buckets.end() && bucket->prefix == prefix) visit(*bucket, value, k);
    }
  });
}

/// The buckets of one digit more that hold a wanted rank, in rising order.
std::vector<Bucket> narrowed(const Column& column, std::vector<Bucket> buckets, int left, int width) {
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  for (Bucket& bucket : buckets) bucket.counts.assign(mask + 1, 0);
  for_each_value(column, buckets, left,
                 [&](Bucket& bucket, double, std::uint64_t k) { ++bucket.counts[(k >> (left - width)) & mask]; });
  std::vector<Bucket> narrow;
  for (const Bucket& bucket : buckets) {
    std::uint64_t before = bucket.before, next = 0;
    for (const std::uint64_t rank : bucket.ranks) {
      while (before + bucket.counts[next] <= rank) before += bucket.counts[next++];
      const std::uint64_t prefix = bucket.prefix << width | next;
      if (narrow.empty() || narrow.back().prefix != prefix) narrow.push_back({prefix, before, bucket.counts[next], {}});
      narrow.back().ranks.push_back(rank);
    }
  }
  return narrow;
}

/// All values in one bucket with the bits that their keys have in common; returns how many are left behind these.
int common_prefix(const Column& column, Bucket& all) {
  std::uint64_t in_all = ~std::uint64_t{0}, in_any = 0;
  column([&](std::span<const double> values) {
    for (const double value : values) {
      in_all &= key(value);
      in_any |= key(value);
    }
  });
  const int left = 64 - std::countl_zero(in_all ^ in_any);
  all.prefix = prefix_of(in_all, left);
  return left;
}

}  // namespace

std::map<std::uint64_t, double> order_statistics(const Column& column, std::uint64_t count,
                                                 const std::set<std::uint64_t>& ranks) {
  std::vector<Bucket> buckets{{0, 0, count, {ranks.begin(), ranks.end()}}};
  int left = common_prefix(column, buckets.front());
  while (left > 0 && size(buckets) > held_at_once) {
    const int width = std::min(left, digit);
    buckets = narrowed(column, std::move(buckets), left, width);
    left -= width;
  }
  // few are left to be sorted; in a bucket without a digit left all are equal
  for_each_value(column, buckets, left, [&](Bucket& bucket, double value, std::uint64_t) {
    if (left > 0 || bucket.values.empty()) bucket.values.push_back(value);
  });
  std::map<std::uint64_t, double> found;
  for (Bucket& bucket : buckets) {
    std::sort(bucket.values.begin(), bucket.values.end());
    for (const std::uint64_t rank : bucket.ranks)
      found[rank] = left > 0 ? bucket.values.at(rank - bucket.before) : bucket.values.front();
  }
  return found;
}

}  // namespace wormdrive
