#include "description/data_sheet.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/numbers/portable.hpp"

namespace wormdrive {
namespace {

/// Radii from teeth; returns tan lambda.
double set_radii(MeshParameters<double>& mesh, const DataSheet& sheet, const DataSheetFault& fault) {
  const double starts = *sheet.starts, module = *sheet.module;
  const double teeth = sheet.i * starts;
  if (std::abs(teeth - std::round(teeth)) > 1e-9 * teeth)  // as far as decimals state a ratio
    fault("starts", fmt::format("mesh.ratio = {} and mesh.starts = {} give the gear {:.6g} teeth; their number must be "
                                "whole",
                                sheet.i, starts, teeth));
  mesh.lg = 0.5 * module * teeth;
  mesh.lw = sheet.a - mesh.lg;
  if (mesh.lw > 0.0) return 0.5 * module * starts / mesh.lw;
  fault("centre_distance_m",
        fmt::format("mesh.centre_distance_m = {} must be greater than {:.6g} m, the pitch radius of "
                    "a gear with {:.6g} teeth and mesh.module_m = {}",
                    sheet.a, mesh.lg, teeth, module));
  return 0.0;
}

double friction_from_one(const DataSheet& sheet, double t, const DataSheetFault& fault) {
  const int stated = sheet.mu.has_value() + sheet.forward.has_value() + sheet.backward.has_value();
  if (stated != 1)
    fault("friction", fmt::format("with mesh.starts and mesh.module_m, state one of mesh.friction, "
                                  "mesh.forward_efficiency and mesh.backward_efficiency; {} are stated",
                                  stated));
  if (sheet.mu) return *sheet.mu;
  const double cos_phi = portable::cos(sheet.phi_n);
  if (sheet.forward) return cos_phi * friction_of_forward(t, *sheet.forward);
  const double backward = sheet.backward.value_or(0.0), mu = cos_phi * friction_of_backward(t, backward);
  if (!(1.0 + backward * t * t > 0.0))
    fault("backward_efficiency",
          fmt::format("mesh.backward_efficiency = {} must be greater than {:.6g}, which infinite friction has",
                      backward, -1.0 / (t * t)));
  return mu;
}

/// Lead angle, radii and friction from both efficiencies; returns tan lambda.
double set_from_efficiencies(MeshParameters<double>& mesh, const DataSheet& sheet, const DataSheetFault& fault) {
  if (!sheet.forward || !sheet.backward || sheet.mu) {
    fault("starts",
          "state mesh.starts and mesh.module_m with one of mesh.friction, mesh.forward_efficiency and "
          "mesh.backward_efficiency, or both efficiencies alone");
    return 0.0;
  }
  const double forward = *sheet.forward, backward = *sheet.backward, square = tan_squared_lead(forward, backward);
  if (!(square > 0.0 && backward <= forward)) {
    fault(
        "backward_efficiency",
        fmt::format("mesh.backward_efficiency = {} must be greater than {:.6g}, 2 - 1/mesh.forward_efficiency, and at "
                    "most {}, mesh.forward_efficiency",
                    backward, 2.0 - 1.0 / forward, forward));
    return 0.0;
  }
  const double t = std::sqrt(square);
  mesh.mu = portable::cos(sheet.phi_n) * friction_of_forward(t, forward);
  mesh.lw = sheet.a / (1.0 + sheet.i * t);
  mesh.lg = sheet.a - mesh.lw;
  return t;
}

}  // namespace

MeshParameters<double> mesh_of(const DataSheet& sheet, const DataSheetFault& fault) {
  MeshParameters<double> mesh{.i = sheet.i, .phi_n = sheet.phi_n, .Jw = sheet.Jw, .Jg = sheet.Jg};
  const bool teeth = sheet.starts && sheet.module;
  const double t = teeth ? set_radii(mesh, sheet, fault) : set_from_efficiencies(mesh, sheet, fault);
  if (t > 1.0) {
    fault("centre_distance_m", fmt::format("the lead angle of the worm is {:.4g} deg; it must be at most 45 deg",
                                           std::atan(t) / unit::degree));
  } else if (t > 0.0) {
    mesh.lambda = std::atan(t);
    if (teeth) mesh.mu = friction_from_one(sheet, t, fault);
  }
  return mesh;
}

}  // namespace wormdrive
