#include "twin/sensitivity.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

#include "scenarios/course.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "thermal/error.h"
#include "thermal/integrate.h"
#include "thermal/parameter_columns.h"
#include "twin/diagnosis/uncertain_number.h"

namespace thermotwin::twin {
namespace {

Value v450() { return read_toml(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin/machines/v450.toml"); }

scenarios::Experiment spectrum() {
  scenarios::Experiment experiment;
  experiment.duration = 2 * 3600.0;
  experiment.ambient.mean = 295.15;
  experiment.spindle.emplace();
  experiment.spindle->blocks = {{3600.0, 600.0, {}}, {1800.0, 200.0, {}}, {1800.0, {}, {}}};
  return experiment;
}

/// Final node temperatures, and their forward sensitivities.
struct Outcome {
  std::vector<double> temperatures;
  std::vector<double> sensitivities;  ///< to the only parameter
};

Outcome outcome(Value const& document, std::vector<thermal::NetworkDerivative> parameters) {
  Machine const machine = Machine::build(document);
  auto const experiment = spectrum();
  scenarios::ExperimentCourse const course(experiment, machine.limits);
  std::vector<double> const start(std::size_t(machine.network().nodes()), 295.15);
  thermal::IntegrationOptions options;
  options.relative_tolerance = options.absolute_tolerance = 1e-9;
  options.parameters = std::move(parameters);
  Outcome result;
  std::vector<double> const times = {0.0, experiment.duration};
  thermal::integrate(machine.network(), course, start, times, options, [&](thermal::Sample const& sample) {
    result.temperatures.assign(sample.temperatures.begin(), sample.temperatures.begin() + std::ptrdiff_t(start.size()));
    if (!sample.sensitivities) return;
    auto const column = sample.sensitivities->col(0);
    result.sensitivities.assign(column.begin(), column.end());
  });
  return result;
}

class SensitivityTo : public testing::TestWithParam<char const*> {};

/// Forward sensitivities against central differences of whole runs, to 1e-4 of the largest one.
TEST_P(SensitivityTo, AgreesWithCentralDifferences) {
  auto const document = v450();
  auto const derivative = differentiate(document, GetParam());
  auto const forward = outcome(document, {derivative.network}).sensitivities;
  double const step = 1e-3 * derivative.parameter.value;
  auto const plus =
      outcome(with_number(document, derivative.parameter, derivative.parameter.value + step), {}).temperatures;
  auto const minus =
      outcome(with_number(document, derivative.parameter, derivative.parameter.value - step), {}).temperatures;
  double largest = 0.0, error = 0.0;
  for (std::size_t i = 0; i < forward.size(); ++i) {
    double const difference = (plus[i] - minus[i]) / (2.0 * step);
    largest = std::max(largest, std::abs(difference));
    error = std::max(error, std::abs(forward[i] - difference));
  }
  EXPECT_GT(largest * std::abs(derivative.parameter.value), 1e-6) << "the parameter does nothing here";
  EXPECT_LT(error, 1e-4 * largest);
}

/// A source, a viscosity-fed friction, a joint, a film, a mass, a material, a length: any number of the file.
INSTANTIATE_TEST_SUITE_P(AnyNumber, SensitivityTo,
                         testing::Values("bearing.front.grease_factor", "bearing.front.pitch_diameter",
                                         "bearing.rear.torque_load", "joint.front_seat.coefficient",
                                         "joint.guide.conductance", "film.head_front.area", "film.test_bar.diameter",
                                         "motor_loss.stator.eddy", "belt.belt.loss", "lump.head_front.mass",
                                         "material.spindle steel.conductivity", "material.casting.specific_heat",
                                         "bar.shaft.outer_diameter"));

TEST(Sensitivity, OfADisplacementWeightIsTheLength) {
  auto const derivative = differentiate(v450(), "material.casting.expansion");
  auto const machine = Machine::build(v450());
  for (std::size_t d = 0; d < machine.displacements.size(); ++d) {
    if (machine.displacements[d].name != "E_X") continue;
    ASSERT_EQ(derivative.displacements[d].size(), 1U);
    EXPECT_NEAR(derivative.displacements[d][0].second, 0.015, 1e-9);
  }
}

/// `grease_factor = 1` says what `1.0` does.
TEST(Sensitivity, AWholeNumberIsANumber) {
  Value document = v450();
  auto const grease = [&](auto value) {
    auto const [table, key] = find_parameter(document, "bearing.front.grease_factor");
    table->find(key)->content = value;
    return differentiate(document, "bearing.front.grease_factor").network.coefficients;
  };
  EXPECT_EQ(grease(std::int64_t{1}), grease(1.0));
}

TEST(Sensitivity, RefusesWhatIsNoNumber) {
  auto const document = v450();
  EXPECT_THROW((void)differentiate(document, "bearing.front.oil"), thermal::InputError);
  EXPECT_THROW((void)differentiate(document, "bearing.front.inner"), thermal::InputError);
  EXPECT_THROW((void)differentiate(document, "bearing.front.inner_share"), thermal::InputError);
  EXPECT_THROW((void)differentiate(document, "bearing.middle.oil"), thermal::InputError);
}

/// How a capacity is spread over a bar does not depend on how much it is: sums of 42 cells round differently.
TEST(Sensitivity, OfACapacityMovesNoPlace) {
  auto document = tests::with_table(read_toml(machine_file("vmc850")), R"(
    [[nut_reversal]]
    name = "hidden"
    nut = "nut"
    screw = "screw"
    nut_length = "60 mm"
    energy = "2 J")");
  static_cast<void>(uncertain_numbers(document));  // states what the file leaves at its default
  std::string const path = "bar.screw.capacity_factor";
  for (double const factor : {1.218864407911368, 1.168862818725809, 1.0918453059819737}) {
    document = with_number(document, find_number(document, path), factor);
    EXPECT_TRUE(thermal::ParameterColumns::has(differentiate(document, path).network)) << factor;
  }
}

}  // namespace
}  // namespace thermotwin::twin
