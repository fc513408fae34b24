// Writes a recording of the ground truth with something hidden in it, for pages and examples:
//   make_recording FILE.csv EFFECT SIZE [DURATION SEED]      EFFECT none: nothing hidden
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>

#include "recovery/truth/excitation.hpp"
#include "recovery/truth/hidden.hpp"

int main(int argc, char** argv) {
  try {
    if (argc < 4) throw std::invalid_argument("usage: make_recording FILE.csv EFFECT SIZE [DURATION SEED]");
    const std::string effect = argv[2];
    const double duration = argc > 4 ? std::stod(argv[4]) : 24.0;
    const std::uint64_t seed = argc > 5 ? std::stoull(argv[5]) : 1;
    truth::Drive drive;
    drive.sensor.counts = 16384;
    truth::Generator generator(seed);
    if (effect != "none") truth::secret(effect).hide(drive, std::stod(argv[3]), generator);
    const auto law = truth::follow(truth::rich_course(seed, duration), truth::Sheet{});
    truth::write_csv(truth::record(drive, law, {.duration = duration, .seed = seed}), argv[1]);
  } catch (const std::exception& fault) {
    std::cerr << "make_recording: " << fault.what() << "\n";
    return 2;
  }
}
