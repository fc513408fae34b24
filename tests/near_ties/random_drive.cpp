#include "near_ties/random_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "judge/equations.hpp"

namespace wormdrive::test::near_ties {

namespace {

using judge::Quad;

constexpr double degree = std::numbers::pi / 180.0;

double torque_ratio(const judge::Drive& d, double m) {
  return d.lw / d.lg * (std::cos(d.phi_n) * std::sin(d.lambda) - m * std::cos(d.lambda)) /
         (std::cos(d.phi_n) * std::cos(d.lambda) + m * std::sin(d.lambda));
}

void choose_mesh(judge::Drive& d, Dice& dice, const Scale& scale) {
  d.i = std::floor(dice.between(15, 80));
  d.lambda = dice.between(2, 12) * degree;
  d.phi_n = dice.between(14.5, 25) * degree;
  d.lw = dice.between(0.008, 0.03);
  d.lg = dice.chance(0.5) ? d.lw * std::tan(d.lambda) * d.i : dice.between(0.03, 0.12);
  const double mu_w = std::cos(d.phi_n) * std::tan(d.lambda);
  switch (dice.below(4)) {
    case 0: d.mu = mu_w; break;  // C1 = 0, as nearly as a double says it
    case 1: d.mu = mu_w * dice.between(0.2, 0.95); break;
    default: d.mu = mu_w * dice.between(1.1, 4.0); break;
  }
  // inertia: of the paper's gear where nothing depends on the angle, else so that the drive moves by a radian at most
  const double way = dice.decades(1e-3, 1.0), torque = scale.load * std::abs(torque_ratio(d, -d.mu));
  d.Jw = dice.chance(0.3) ? dice.decades(5e-6, 5e-4) : torque * scale.time * scale.time / (way * d.i);
  const double least = 2.0 * std::max(0.0, -torque_ratio(d, 1.3 * d.mu + 0.05));  // eq. 17, with room for effects
  const double most = least > 0.0 ? d.Jw * d.i / least : d.Jw * d.i * 20.0;
  d.Jg = std::min(most, d.Jw * d.i * dice.decades(0.05, 10.0));
}

void choose_effects(judge::Drive& d, Dice& dice, const Scale& scale) {
  const double torque = scale.load * (d.teeth ? std::abs(torque_ratio(d, -d.mu)) : 1.0);
  const bool follows_angle = d.teeth ? d.Jw * d.i > 0.3 * torque * scale.time * scale.time : true;
  for (int left = dice.below(6); left > 0; --left) switch (dice.below(12)) {
      case 0: d.torque_gain = dice.between(-0.2, 0.2); break;
      case 1: d.torque_offset = torque * dice.between(-0.1, 0.1); break;
      case 2: d.worm_coulomb = torque * dice.between(0.01, 0.3); break;
      case 3: d.gear_coulomb = scale.load * dice.between(0.01, 0.2); break;
      case 4: d.gear_viscous = d.Jg / scale.time * dice.decades(0.1, 10.0); break;
      case 5:
        if (d.teeth) d.worm_viscous = d.Jw / scale.time * dice.decades(0.1, 10.0);
        break;
      case 6:
        if (d.teeth) d.friction_asymmetry = d.mu * dice.between(-0.2, 0.2);
        break;
      case 7: d.bearing_asymmetry = judge::BearingAsymmetry{torque * dice.between(-0.05, 0.05), 0.0}; break;
      case 8:
        if (d.teeth && !scale.elastic)
          d.static_friction = judge::StaticFriction{0.2 * d.mu * dice.between(0, 1),
                                                    dice.chance(0.5) ? 0.0 : scale.time * dice.decades(0.1, 100.0)};
        break;
      case 9:
        if (d.teeth)
          d.stribeck =
              judge::Stribeck{d.mu * dice.between(0.05, 0.6), d.lw * d.i / scale.time * dice.decades(1e-3, 1.0)};
        break;
      case 10:
        if (follows_angle)
          d.cogging =
              judge::Cogging{torque * dice.between(0.01, 0.2), std::floor(dice.between(1, 7)), dice.between(-3, 3)};
        break;
      case 11:
        if (follows_angle && dice.chance(0.5))
          d.load_spring = judge::LoadSpring{scale.load * dice.between(0.05, 1.0), dice.between(-0.5, 0.5)};
        else if (follows_angle && d.teeth && !scale.elastic)
          d.transmission_error = judge::TransmissionError{dice.between(-0.02, 0.02), dice.between(-3, 3)};
        break;
    }
}

/// Two of the equations' answers, for a motor torque of 0 and of 1 N m, of which each is linear.
struct Line {
  Quad at_0, at_1;
  Quad root() const { return -at_0 / (at_1 - at_0); }
};
template <class Answer>
Line line(const judge::Drive& d, int direction, int flank, double load, bool at_rest, Answer answer) {
  const judge::Equations<Quad> equations(d);
  const auto ask = [&](double motor) {
    judge::Circumstances<judge::Sized> at{Quad(motor), Quad(load), Quad(d.theta), Quad(at_rest ? 0.0 : d.omega)};
    if (at_rest) at.rest = judge::Sized(0);
    return answer(equations(at, direction, flank)).value;
  };
  return {ask(0.0), ask(1.0)};
}

}  // namespace

judge::Drive random_drive(Dice& dice, const Scale& scale) {
  judge::Drive d;
  d.teeth = scale.elastic || !dice.chance(0.1);
  choose_mesh(d, dice, scale);
  if (!d.teeth) d.Jg = scale.load * scale.time * scale.time / dice.decades(1e-3, 1.0);
  choose_effects(d, dice, scale);
  return d;
}

double break_in(const judge::Drive& drive, int direction, double load) {
  const auto pull = [](const auto& outcome) { return outcome.pull; };
  const Quad left = line(drive, direction, 1, load, true, pull).root(),
             right = line(drive, direction, -1, load, true, pull).root();
  return static_cast<double>(direction > 0 ? std::max(left, right) : std::min(left, right));
}

double surface(const judge::Drive& drive, int direction, double load) {
  const auto beyond = [](const auto& outcome) { return outcome.beyond; };
  return static_cast<double>(line(drive, direction, 1, load, false, beyond).root());
}

}  // namespace wormdrive::test::near_ties
