#include <cmath>
#include <iostream>

#include "catch.hpp"
#include "compliant_drives.hpp"

// Fig. 9 with elastic teeth: against an integration of its own, and on its way to the rigid drive.

namespace wormdrive::test::events_compliant_fig09 {

namespace {

constexpr double pi = std::numbers::pi;

double load_at(double theta_g) { return 0.0196 * std::cos(theta_g); }

struct Fig9 {
  double stiffness, damping, backlash;
  MeshParameters<double> p = table1();

  auto drive() const {
    return compliant(p, fig9_load(), fig9_motor(), {HuntCrossley<double>{stiffness, damping}, backlash});
  }
  /// Worm angle at which the load rests on the left flank, the gear at angle 0 [rad].
  double rest() const {
    const double arm = p.lg * std::cos(p.phi_n), Wn = load_at(0.0) * std::cos(p.lambda) / arm;
    return -p.i * (backlash / 2 + Wn / stiffness / (arm * std::cos(p.lambda)));
  }
  auto run_to(double end, double report, const SolverSettings& settings = tight(bdf, 1e-11)) const {
    return run(drive(), Timetable(0, end, report), {0.0, {rest(), 0.0, 0.0, 0.0}, {}}, settings);
  }
};

/// The same drive in formulas of its own. State: the angles and speeds of worm and gear, and the time.
struct TwoBodies {
  Fig9 is;
  int motion = 0;

  using State = std::array<double, 5>;
  struct Contact {
    int flank;
    double force;
  };
  Contact contact(const State& x) const {
    const double arm = is.p.lg * std::cos(is.p.phi_n) * std::cos(is.p.lambda);
    const double lead = x[2] - x[0] / is.p.i, side = lead > 0.0 ? 1.0 : -1.0;
    const double d = arm * (side * lead - is.backlash / 2), v = arm * side * (x[3] - x[1] / is.p.i);
    const double push = 1.0 + is.damping * v;
    if (d <= 0.0 || push <= 0.0) return {0, 0.0};
    return {side > 0.0 ? 1 : -1, is.stiffness * d * push};
  }
  double motor(const State& x) const { return -0.05 * std::sin(3.0 * pi * x[4]); }
  /// Friction that keeps the worm at rest [N].
  double holding(const State& x) const {
    const Contact c = contact(x);
    return (motor(x) / is.p.lw + c.flank * c.force * std::cos(is.p.phi_n) * std::sin(is.p.lambda)) /
           std::cos(is.p.lambda);
  }
  State operator()(double, const State& x) const {
    const Contact c = contact(x);
    const double Wf = motion == 0 ? holding(x) : motion * is.p.mu * c.force;
    const double normal = c.flank * c.force * std::cos(is.p.phi_n);
    const double worm = motor(x) + (normal * std::sin(is.p.lambda) - Wf * std::cos(is.p.lambda)) * is.p.lw;
    const double gear = load_at(x[2]) - (normal * std::cos(is.p.lambda) + Wf * std::sin(is.p.lambda)) * is.p.lg;
    return {x[1], motion == 0 ? 0.0 : worm / is.p.Jw, x[3], gear / is.p.Jg, 1.0};
  }
  /// Where the formulas change: the flank, and the worm's release or reversal.
  int region(const State& x) const {
    const Contact c = contact(x);
    const bool goes_on = motion == 0 ? std::abs(holding(x)) <= is.p.mu * c.force : motion * x[1] >= 0.0;
    return 2 * c.flank + goes_on;
  }
  /// The direction in which the worm goes on.
  void decide(State& x) {
    if (motion != 0 && motion * x[1] > 1e-12) return;
    x[1] = 0.0;
    const double Wf = holding(x);
    motion = std::abs(Wf) <= is.p.mu * contact(x).force ? 0 : Wf > 0.0 ? 1 : -1;
  }
};

}  // namespace

TEST_CASE("fig. 9 with elastic teeth has the states and event times of a fixed-step integration at 1 us") {
  const Fig9 is{1e6, 1000.0, 1e-3};
  const double h = 1e-6, end = 1.0;
  const auto ours = is.run_to(end, 0.01, tight(bdf, 1e-14));

  TwoBodies bodies{is};
  TwoBodies::State x{is.rest(), 0.0, 0.0, 0.0, 0.0};
  std::vector<double> theirs;
  Deviation gear, worm, times;
  long step = 0;
  for (const auto& row : ours.rows) {
    const long k = std::lround(row.now.t / h);
    if (std::abs(row.now.t - static_cast<double>(k) * h) > 1e-14) continue;
    for (; step < k; ++step) {
      const auto crossed = [&](double t, TwoBodies::State& at) {
        theirs.push_back(t);
        bodies.decide(at);
      };
      piecewise_step([&](double t, const auto& y) { return bodies(t, y); },
                     [&](const auto& y) { return bodies.region(y); }, crossed, static_cast<double>(step) * h, x, h);
    }
    worm.add(row.now.x[1] - x[1]);
    gear.add(row.now.x[3] - x[3]);
  }
  REQUIRE(theirs.size() == ours.events.size());
  for (std::size_t n = 0; n < theirs.size(); ++n) times.add(ours.events[n].after.t - theirs[n]);
  INFO(theirs.size() << " events; largest deviation: times " << times << " s, worm " << worm << " rad/s, gear " << gear
                     << " rad/s");
  REQUIRE(times <= 1e-9);
  REQUIRE(worm <= 1e-7);
  REQUIRE(gear <= 1e-8);
}

namespace {

/// Modes of the rigid kind: no flank at rest, free intervals shorter than a time [s] left out.
template <class System>
std::vector<Mode> merged(const Run<System>& r, double shortest) {
  std::vector<Mode> modes;
  const auto add = [&](Mode mode) {
    if (mode.motion == Motion::stuck) mode.flank = Flank::none;
    if (modes.empty() || !(modes.back() == mode)) modes.push_back(mode);
  };
  add(r.rows.front().now.mode);
  for (std::size_t n = 0; n < r.events.size(); ++n) {
    const auto& now = r.events[n].after;
    const bool last = n + 1 == r.events.size();
    if (now.mode.contact == Flank::none && !last) {
      std::size_t back = n + 1;  // where the teeth touch again
      while (back + 1 < r.events.size() && r.events[back].after.mode.contact == Flank::none) ++back;
      if (r.events[back].after.t - now.t < shortest) continue;
    }
    add(now.mode);
  }
  return modes;
}

/// What differs from the rigid drive over two seconds, reported every ms.
struct Distance {
  Deviation angle, speed;
};
template <class Elastic, class Rigid>
Distance distance(const Elastic& elastic, const Rigid& rigid) {
  std::map<long, typename Rigid::Instant> rows;
  for (const auto& row : rigid.rows) rows[std::lround(row.now.t * 1e6)] = row.now;
  Distance d;
  for (const auto& row : elastic.rows) {
    const auto found = rows.find(std::lround(row.now.t * 1e6));
    if (found == rows.end() || std::abs(found->second.t - row.now.t) > 1e-12) continue;
    d.angle.add(row.now.x[2] - found->second.x[0]);
    d.speed.add(row.now.x[3] - found->second.x[1]);
  }
  return d;
}

}  // namespace

TEST_CASE("fig. 9 becomes the rigid drive's as the teeth become stiff and the gap closes, with order 1 in 1/k",
          "[slow]") {
  const auto rigid = run(drive(table1(), fig9_load(), fig9_motor()), Timetable(0, 2, 0.001), {});
  const GearMesh<double> mesh(table1());
  for (const double first_gap : {0.0, 1e-5}) {
    std::vector<double> angle, speed;
    for (const double stiffer : {1.0, 4.0, 16.0, 64.0, 256.0}) {
      // a gap is crossed in a time that goes with its cube root, a contact lasts 1/sqrt(k): so both shrink alike
      const double k = 1e6 * stiffer, gap = first_gap * std::pow(stiffer, -1.5);
      const auto elastic = Fig9{k, 1000.0, gap}.run_to(2.0, 0.001);
      const Distance to = distance(elastic, rigid);
      angle.push_back(to.angle.size);
      speed.push_back(to.speed.size);
      std::cout << "fig. 9, k " << k << " N/m, gap " << gap << " rad: " << elastic.events.size() << " events, angle "
                << to.angle << " rad and speed " << to.speed << " rad/s from the rigid drive\n"
                << std::defaultfloat;
      // One flank change of fig. 9 is 1 ms before a reversal; a gap that is not crossed by then hides it.
      const double period = 2 * pi / (mesh.gear_arm(0.0) * std::sqrt(k / mesh.Jg));
      if (gap == 0.0 || stiffer >= 64.0) REQUIRE(merged(elastic, 10 * period) == rigid.modes());
    }
    const auto order = [](const std::vector<double>& error) {
      return std::log(error.front() / error.back()) / std::log(256.0);
    };
    std::cout << "order in 1/k: angle " << order(angle) << ", speed " << order(speed) << "\n";
    REQUIRE(order(angle) >= 0.85);
    REQUIRE(order(angle) <= 1.15);
    REQUIRE(angle.back() <= 3e-7);
    REQUIRE(speed.back() <= 3e-5);
  }
}

TEST_CASE("power series refuse elastic teeth by name") {
  REQUIRE_THROWS_WITH((Fig9{1e6, 1000.0, 0.0}.run_to(1.0, 1.0, tight(taylor))),
                      "the solver \"taylor\" follows rigid drives only; set run.solver = \"cvode\"");
}

}  // namespace wormdrive::test::events_compliant_fig09
