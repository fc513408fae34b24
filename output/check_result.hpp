#pragma once
#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/stored_table.hpp"

namespace wormdrive {

/// Looks at all that readers of a result rely on: its kind, and type, length and range of every column that results of
/// this kind have; see output/schema.md. What else stands in the file is no fault of it. Throws ReadFault.
void check_result(hid_t file);

/// The same of the tables of a run alone, whoever wrote them.
void check_run(hid_t file);

}  // namespace wormdrive
