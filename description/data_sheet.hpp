#pragma once
#include <functional>
#include <string>

#include "core/data_sheet.hpp"

namespace wormdrive {

/// Notes a fault of a data sheet at a key of its table.
using DataSheetFault = std::function<void(const std::string& key, const std::string& what)>;

/// The mesh that a data sheet describes; of no use where a fault is noted.
MeshParameters<double> mesh_of(const DataSheet& sheet, const DataSheetFault& fault);

}  // namespace wormdrive
