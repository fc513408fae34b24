#pragma once
#include <string>

#include "diagnosis/diagnosis.hpp"
#include "output/part_file.hpp"

namespace wormdrive {

/// Writes what a diagnosis found as tables of an HDF5 file; see output/schema.md. Throws OutputFault.
void write_diagnosis(const std::string& path, const Diagnosis& diagnosis, const Provenance& provenance);

}  // namespace wormdrive
