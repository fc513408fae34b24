#pragma once
#include <string_view>
#include <vector>

#include "diagnosis/candidates/catalogue.hpp"

namespace wormdrive {

/// One coordinate that is a field.
Coordinate plain_coordinate(std::string_view effect, std::string_view field, double scale, double low, double high);

/// A candidate that acts in proportion to one field.
Candidate linear(std::string_view effect, std::string_view field, double scale, double low, double high);

/// One whose signature is what some sizes of it do.
Candidate finite(std::string_view effect, std::string_view field, double scale, double low, double high,
                 const std::vector<double>& starts);

/// What shifts or smears a torque in time [s], by so little at least, in recordings of a period.
Candidate late(std::string_view effect, std::string_view field, double period, double least);

}  // namespace wormdrive
