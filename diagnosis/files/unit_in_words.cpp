#include "diagnosis/files/unit_in_words.hpp"

#include <array>
#include <string>

#include "core/unit.hpp"

namespace wormdrive {
namespace {

/// Without what is written in different ways: blanks, dots and stars between factors, marks of powers.
std::string bare(std::string_view words) {
  std::string text(words);
  for (const std::string_view mark : {" ", ".", "*", "^", "\u00b7", "\u22c5"})
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at))
      text.erase(at, mark.size());
  return text;
}

struct Word {
  std::string_view text, si;
  double size;
};

constexpr double per_minute = 2.0 * std::numbers::pi / 60.0;

/// What no prefix leads to.
constexpr std::array words_for_units{Word{"sec", "s", 1.0},
                                     Word{"second", "s", 1.0},
                                     Word{"seconds", "s", 1.0},
                                     Word{"min", "s", 60.0},
                                     Word{"radian", "rad", 1.0},
                                     Word{"radians", "rad", 1.0},
                                     Word{"deg", "rad", unit::degree},
                                     Word{"degree", "rad", unit::degree},
                                     Word{"degrees", "rad", unit::degree},
                                     Word{"\u00b0", "rad", unit::degree},
                                     Word{"rads-1", "rad/s", 1.0},
                                     Word{"rad/sec", "rad/s", 1.0},
                                     Word{"deg/s", "rad/s", unit::degree},
                                     Word{"rpm", "rad/s", per_minute},
                                     Word{"1/min", "rad/s", per_minute},
                                     Word{"ms-1", "m/s", 1.0},
                                     Word{"cm", "m", 0.01},
                                     Word{"Ncm", "N m", 0.01},
                                     Word{"Nmm", "N m", 1e-3}};

struct Prefix {
  std::string_view text;
  double size;
};
constexpr std::array prefixes{Prefix{"m", 1e-3},      Prefix{"u", 1e-6}, Prefix{"\u00b5", 1e-6},
                              Prefix{"\u03bc", 1e-6}, Prefix{"n", 1e-9}, Prefix{"k", 1e3}};

}  // namespace

std::optional<double> unit_in_words(std::string_view words, std::string_view si) {
  const std::string text = bare(words), sought = bare(si);
  if (text == sought) return 1.0;
  for (const Word& word : words_for_units)
    if (text == word.text && si == word.si) return word.size;
  for (const Prefix& prefix : prefixes)
    if (text.starts_with(prefix.text) && text.substr(prefix.text.size()) == sought) return prefix.size;
  return std::nullopt;
}

}  // namespace wormdrive
