#pragma once
#include <cstddef>
#include <vector>

#include "diagnosis/data/recording.hpp"
#include "diagnosis/rules/recordings.hpp"

namespace wormdrive {

/// Of all of them.
std::size_t samples_of(const std::vector<Recording>& recordings);

/// Recordings of which a search for causes makes do: of those that are longer than it needs, pieces from all of their
/// time. Each recording is divided into sections, and of each section the piece stays in which the gear moves most.
/// most: samples of all that stay, about.
std::vector<Recording> representative_pieces(const std::vector<Recording>& recordings,
                                             std::size_t most = rules::most_searched);

}  // namespace wormdrive
