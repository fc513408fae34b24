#pragma once
#include "diagnosis/data/prepared_recording.hpp"
#include "diagnosis/faults/recording_faults.hpp"

namespace wormdrive {

/// A recording as it would be without some faults.
PreparedRecording mended(PreparedRecording recording, const RecordingFaults& faults);

}  // namespace wormdrive
