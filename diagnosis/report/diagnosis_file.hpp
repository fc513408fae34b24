#pragma once
#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "output/hdf5/table.hpp"
#include "output/run_file.hpp"

namespace wormdrive {

/// Columns in the units and words of an axis.
std::vector<ColumnDescription> on_axis(Axis axis, std::vector<ColumnDescription> columns);

/// Writes what a diagnosis found as tables of an HDF5 file; see output/schema.md. Throws OutputFault.
void write_diagnosis(const std::string& path, const Diagnosis& diagnosis, const Provenance& provenance,
                     Replace replace = Replace::same_kind);

}  // namespace wormdrive
