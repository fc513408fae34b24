// Gives every target mutated inputs for a number of times: fuzz TARGET|all RUNS [SEED]; of all targets the slow ones
// less often. What ends it is in fuzz_TARGET.input. It needs no more than a compiler; with clang the same targets run
// under libFuzzer.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <unistd.h>

#include <fcntl.h>

#include "fuzz/targets.hpp"

namespace {

using namespace wormdrive::fuzz;

constexpr unsigned longest = 30;  ///< seconds that an input may take
constexpr std::size_t largest = 1 << 16;

Bytes now;  ///< the input that is being taken
std::string name_of_file;

void keep(int signal) {
  const int file = open(name_of_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0 && write(file, now.data(), now.size()) >= 0) close(file);
  std::signal(signal, SIG_DFL);
  raise(signal == SIGALRM ? SIGABRT : signal);
}

class Mutator {
 public:
  Mutator(const Target& target, std::vector<Bytes> corpus, std::uint64_t seed)
      : target_(target), corpus_(std::move(corpus)), random_(seed) {}

  Bytes next() {
    Bytes input = corpus_[below(corpus_.size())];
    for (std::size_t k = below(8) + 1; k > 0; --k) change(input);
    if (input.size() > largest) input.resize(largest);
    return input;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }
  static auto at(Bytes& input, std::size_t k) { return input.begin() + static_cast<std::ptrdiff_t>(k); }
  void insert(Bytes& input, const Bytes& piece) {
    input.insert(at(input, below(input.size() + 1)), piece.begin(), piece.end());
  }

  void change(Bytes& input) {
    const std::size_t begin = below(input.size()), length = std::min(input.size() - begin, below(20) + 1);
    switch (below(7)) {
      case 0:
        if (!input.empty()) input[begin] = static_cast<std::uint8_t>(random_());
        break;
      case 1:
        if (!input.empty()) input[begin] ^= static_cast<std::uint8_t>(1U << below(8));
        break;
      case 2: input.erase(at(input, begin), at(input, begin + length)); break;
      case 3: insert(input, Bytes(at(input, begin), at(input, begin + length))); break;
      case 4: {
        const Bytes& other = corpus_[below(corpus_.size())];
        const std::size_t from = below(other.size()), size = std::min(other.size() - from, below(60) + 1);
        insert(input, Bytes(other.begin() + static_cast<std::ptrdiff_t>(from),
                            other.begin() + static_cast<std::ptrdiff_t>(from + size)));
        break;
      }
      case 5:
        if (!target_.words.empty()) {
          const std::string& word = target_.words[below(target_.words.size())];
          insert(input, Bytes(word.begin(), word.end()));
        }
        break;
      default: insert(input, {static_cast<std::uint8_t>(random_()), static_cast<std::uint8_t>(random_())}); break;
    }
  }

  const Target& target_;
  std::vector<Bytes> corpus_;
  std::mt19937_64 random_;
};

void run(const Target& target, long runs, std::uint64_t seed) {
  std::string folder = (std::filesystem::temp_directory_path() / "wormdrive_fuzz_XXXXXX").string();
  if (!mkdtemp(folder.data())) std::abort();
  name_of_file = "fuzz_" + target.name + ".input";
  std::vector<Bytes> corpus = target.seeds(folder);
  for (const Bytes& good : corpus) target.take(good.data(), good.size());
  Mutator mutator(target, std::move(corpus), seed);
  for (long k = 0; k < runs; ++k) {
    now = mutator.next();
    alarm(longest);
    target.take(now.data(), now.size());
    alarm(0);
  }
  std::filesystem::remove_all(folder);
  std::printf("%s: %ld inputs\n", target.name.c_str(), runs);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  for (const int signal : {SIGSEGV, SIGABRT, SIGALRM, SIGBUS, SIGFPE}) std::signal(signal, keep);
  bool known = false;
  for (const Target& target : targets())
    if (std::string(argv[1]) == "all" || target.name == argv[1]) {
      known = true;
      run(target, std::string(argv[1]) == "all" ? std::atol(argv[2]) / target.slower : std::atol(argv[2]),
          argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
    }
  return known ? 0 : 2;
}
