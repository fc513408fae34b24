#pragma once
#include <cstddef>
#include <vector>

namespace wormdrive {

/// The rows of a table that show every extreme: all of a short one; of a long one the first, the last and, of equally
/// many rows each, those where a column is largest and smallest, and the first gap (NaN).
std::vector<std::size_t> rows_with_extremes(const std::vector<const std::vector<double>*>& columns);

/// The same number of rows at equal distances, the first and the last among them: for columns that rise.
std::vector<std::size_t> even_rows(std::size_t rows, std::size_t wanted);

}  // namespace wormdrive
