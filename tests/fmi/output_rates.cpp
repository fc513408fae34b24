// Derivatives of outputs by time at communication points, judged by differences of the outputs themselves from one
// point to the next.
#include "fmi/exported.hpp"
#include "fmi/importer3.hpp"
#include "fmi/stepper.hpp"

namespace wormdrive::test::fmi_output_rates {

namespace {

const std::vector<std::string> loop{"--kind", "loop"};

double rate(Instance& model, const std::string& name, int order = 1) {
  const unsigned reference = model.fmu().reference(name);
  double found = 0.0;
  model.call<decltype(fmi2GetRealOutputDerivatives)>("fmi2GetRealOutputDerivatives", &reference, size_t{1}, &order,
                                                     &found);
  return found;
}

/// At the middle of two short steps, where no event and no sample falls into them, every output has the rate that its
/// values on both sides give.
void rates_are_differences(const Exported& exported, const std::vector<std::string>& outputs) {
  const double end = exported.scenario.run.duration;
  Stepper stepper(*exported.fmu, end);
  const double h = 1e-5;
  const auto values = [&] {
    std::vector<double> all;
    for (const std::string& name : outputs) all.push_back(stepper.model.real(name));
    return all;
  };
  int compared = 0;
  std::vector<double> largest(outputs.size(), 0.0);
  for (int k = 0; stepper.t + 0.0137 + 2.0 * h < end; ++k) {
    stepper.step(0.0137);
    const std::vector<double> left = values();
    const double torque = stepper.model.real("motor_torque");
    const int events = stepper.step(h).events;
    std::vector<double> exact;
    for (const std::string& name : outputs) exact.push_back(rate(stepper.model, name));
    if (stepper.step(h).events != events) continue;
    if (exported.scenario.control && stepper.model.real("motor_torque") != torque) continue;  // sampled in between
    const std::vector<double> right = values();
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      INFO(outputs[i] << " at " << stepper.t - h << " s");
      const double difference = (right[i] - left[i]) / (2.0 * h);
      largest[i] = std::max(largest[i], std::abs(exact[i]));
      CHECK(std::abs(exact[i] - difference) < 1e-5 * largest[i] + 1e-13 * std::abs(right[i]) / h + 1e-9);
    }
    ++compared;
  }
  CHECK(compared > 20);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    INFO(outputs[i]);
    CHECK(largest[i] > 0.0);
  }
}

}  // namespace

TEST_CASE("outputs have the rates with which they change") {
  const std::vector<std::string> outputs{"gear_angle", "gear_speed", "normal_force", "measured_angle", "motor_torque"};
  rates_are_differences(Exported(shipped("fig09_switching.toml"), {"effect.encoder_scale.share=0.01"}, loop), outputs);
  std::vector<std::string> followed = outputs;
  followed.pop_back();  // held from sample to sample
  followed.insert(followed.end(), {"reference_angle", "reference_speed"});
  rates_are_differences(
      Exported(shipped("fig10_sliding_014rad_bare.toml"), {"run.duration_s=1", "metrics.from_s=0"}, loop), followed);
  rates_are_differences(  // an encoder on the worm
      Exported(shipped("fig10_sliding_014rad_bare.toml"),
               {"run.duration_s=1", "metrics.from_s=0", "sensor.shaft=worm",
                "effect.transmission_error.amplitude_deg=0.5", "effect.transmission_error.phase_deg=30"},
               loop),
      {"gear_angle", "gear_speed", "measured_angle"});
}

TEST_CASE("FMI 3.0: outputs have the rates of FMI 2.0") {
  const Exported second(shipped("fig09_switching.toml"), {}, loop),
      third(shipped("fig09_switching.toml"), {}, {"--kind", "loop", "--fmi", "3"});
  Stepper old(*second.fmu, 1.0);
  old.step(0.3);
  Instance3 model(*third.fmu, true);
  model.initialize(1.0);
  model.step(0.0, 0.3);
  for (const std::string name : {"gear_speed", "normal_force"}) {
    const unsigned reference = third.fmu->reference(name);
    const int order = 1;
    double found = 0.0;
    model.call<decltype(fmi3GetOutputDerivatives)>("fmi3GetOutputDerivatives", &reference, size_t{1}, &order, &found,
                                                   size_t{1});
    CHECK(found == rate(old.model, name));
  }
}

TEST_CASE("outputs without a rate, and rates of a higher order, are refused") {
  const Exported exported(shipped("fig09_switching.toml"));
  Stepper plant(*exported.fmu, 1.0);
  plant.step(0.1);
  CHECK_THROWS_WITH(rate(plant.model, "gear_angle", 2), "there are no derivatives of order 2, only of 1");
  CHECK_THROWS_WITH(rate(plant.model, "motor_torque"),
                    "value reference 8 is no continuous output with a rate in co-simulation");
  CHECK_THROWS_WITH(rate(plant.model, "event_time"),
                    "value reference 11 is no continuous output with a rate in co-simulation");
}

}  // namespace wormdrive::test::fmi_output_rates
