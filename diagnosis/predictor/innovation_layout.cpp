#include "diagnosis/predictor/innovation_layout.hpp"

#include <algorithm>
#include <utility>

namespace wormdrive {

InnovationLayout::InnovationLayout(std::vector<PreparedRecording> all) : recordings(std::move(all)) {
  std::size_t wanted = 0;
  for (const PreparedRecording& r : recordings) {
    begins.push_back(samples);
    first_blocks.push_back(blocks);
    samples += r.samples();
    blocks += r.blocks();
    wanted += r.samples() * (r.worm_angle.empty() ? 1 : 2);
  }
  group.reserve(wanted);
  part.reserve(wanted);
  share.reserve(wanted);
  block.reserve(wanted);
  for (const bool of_worm : {false, true})
    for (std::size_t q = 0; q < recordings.size(); ++q) {
      const PreparedRecording& r = recordings[q];
      if (of_worm && r.worm_angle.empty()) continue;
      for (std::size_t k = 0; k < r.samples(); ++k) {
        group.push_back(static_cast<std::uint8_t>(2 * channels.size() + (r.moving[k] ? 1 : 0)));
        part.push_back(static_cast<std::uint8_t>(!r.used[k] ? 0 : r.held_out[k] ? 2 : 1));
        share.push_back(r.share(k));
        block.push_back(static_cast<std::uint32_t>(first_blocks[q] + k / r.block_length));
      }
      channels.push_back({q, of_worm, size, of_worm ? r.worm_resolution : r.data.gear_resolution});
      size += r.samples();
    }
}

const Channel& InnovationLayout::leading(std::size_t recording) const {
  return *std::find_if(channels.rbegin(), channels.rend(), [&](const Channel& c) { return c.recording == recording; });
}

double InnovationLayout::fitted() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < size; ++k)
    if (part[k] == 1) sum += share[k];
  return sum;
}

}  // namespace wormdrive
