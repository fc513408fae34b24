#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "catch.hpp"
#include "diagnosis/predictor/noise_model.hpp"

// What rounding does to estimates. The judge is arithmetic: errors with mean zero have their centre at zero.

namespace wormdrive::test::diagnosis_coarse_encoder {

namespace {

/// One moving recording, all of it fitted.
InnovationLayout layout_of(std::size_t samples, double resolution) {
  PreparedRecording r;
  r.data.period = 1e-3;
  r.data.gear_angle.assign(samples, 0.0);
  r.data.motor_torque.assign(samples, 0.0);
  r.data.gear_resolution = resolution;
  r.moving.assign(samples, 1);
  r.used.assign(samples, 1);
  r.held_out.assign(samples, 0);
  r.block_length = 500;
  r.rms_speed = 1e-3;
  return InnovationLayout({r});
}

/// Errors of rounding of a gear that moves by nearly two thirds of a step per sample, with noise: a third of them lies
/// at the end of a step while the others make up for it. Their mean is zero.
std::vector<double> skewed(std::size_t samples, double step, double noise, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, noise);
  std::uniform_real_distribution<double> around(-1.0, 1.0);
  std::vector<double> e(samples);
  for (std::size_t k = 0; k < samples; ++k)
    e[k] = step * (k % 3 == 0 ? 0.42 + 0.08 * around(random) : -0.21 + 0.04 * around(random)) + normal(random);
  const double mean = std::accumulate(e.begin(), e.end(), 0.0) / static_cast<double>(samples);
  for (double& x : e) x -= mean;
  return e;
}

/// Where reweighted least squares see the centre of the errors.
double centre(const InnovationLayout& layout, std::vector<double> e) {
  const NoiseModel noise = estimate_noise(layout, e, false);
  double sum = 0.0;
  for (int round = 0; round < 50; ++round) {
    const std::vector<double> weight = fit_weights(layout, e, noise);
    const double shift = std::inner_product(e.begin(), e.end(), weight.begin(), 0.0) /
                         std::accumulate(weight.begin(), weight.end(), 0.0);
    for (double& x : e) x -= shift;
    sum += shift;
  }
  return sum;
}

}  // namespace

TEST_CASE("errors of rounding that are skewed bias nothing, however coarse the encoder") {
  std::mt19937_64 random(7);
  constexpr std::size_t samples = 6000;
  constexpr double noise = 1e-5;
  for (const double steps : {0.1, 1.0, 3.0, 10.0, 100.0, 1e4}) {
    const double step = steps * noise;
    CAPTURE(steps);
    const double error = std::hypot(noise, 0.3 * step);
    CHECK(std::abs(centre(layout_of(samples, step), skewed(samples, step, noise, random))) <= 0.05 * error);
  }
}

TEST_CASE("outliers keep little weight beside an encoder that is finer than the noise") {
  std::mt19937_64 random(8);
  constexpr std::size_t samples = 6000;
  constexpr double noise = 1e-5;
  std::vector<double> e = skewed(samples, 0.1 * noise, noise, random);
  for (std::size_t k = 0; k < samples; k += 100) e[k] = 1e-2;
  CHECK(std::abs(centre(layout_of(samples, 0.1 * noise), e)) <= 0.02 * noise);
}

TEST_CASE("likelihoods of all resolutions are densities of the same kind") {
  std::mt19937_64 random(9);
  constexpr std::size_t samples = 6000;
  const auto total = [&](double step) {
    const InnovationLayout layout = layout_of(samples, step);
    const NoiseModel noise = estimate_noise(layout, skewed(samples, step, 1e-5, random), false);
    // each of the samples a place of one density: exp(-misfit) adds up to its integral
    const double scale = noise.groups[1].scale;
    constexpr double far = 3000.0;  // scales; what is beyond is less than 1e-12 of all
    double sum = 0.0;
    const InnovationLayout one = layout_of(1, step);
    for (double x = -far; x <= far; x += 0.05)
      sum += 0.05 * scale * std::exp(-misfit(one, std::vector{x * scale}, noise).fitted);
    return sum;
  };
  const double fine = total(0.0);
  for (const double step : {1e-6, 1e-5, 3e-5, 1e-4, 1e-3}) CHECK(std::abs(total(step) / fine - 1.0) <= 1e-6);
}

}  // namespace wormdrive::test::diagnosis_coarse_encoder
