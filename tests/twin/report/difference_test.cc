#include "twin/report/difference.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/twin/report/in_other_units.h"
#include "thermal/error.h"
#include "thermal/growth_field.h"
#include "twin/experiment_file.h"
#include "twin/file/text_file.h"
#include "twin/machine.h"
#include "twin/report/carried_residual.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::TemporaryDirectory;
using thermal::InputError;

/// The numbers of a file of cells by node, as VTK reads them.
Eigen::MatrixXd cells_of(std::filesystem::path const& path, char const* name, Eigen::Index nodes) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  auto& data = *reader->GetOutput()->GetCellData();
  auto* const array = data.GetArray(name);
  auto* const node = data.GetArray("node");
  if (!array || !node) return {};
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(nodes, array->GetNumberOfComponents(), std::nan(""));
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      values(Eigen::Index(node->GetTuple1(i)), c) = array->GetComponent(i, c);
  return values;
}

/// Sensors by name.
std::map<std::string, double> points_of(std::filesystem::path const& path, char const* name) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  auto& data = *reader->GetOutput()->GetPointData();
  auto* const names = vtkStringArray::SafeDownCast(data.GetAbstractArray("name"));
  std::map<std::string, double> values;
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
    values[names->GetValue(i)] = data.GetArray(name)->GetTuple1(i);
  return values;
}

class Difference : public testing::Test {
 protected:
  /// Two hours of v450 with all its nodes.
  static void SetUpTestSuite() {
    auto document = read_toml(experiment_file("golden_b_4000"));
    set_parameter(document, "duration", "2 h");
    RunOptions options;
    options.node_temperatures = true;
    options.provenance = {{"machine.file", text_of_file(machine_file("v450"))}, {"settings", ""}};
    dataset = run(machine(), read_experiment(document, experiment_file("golden_b_4000")), options).dataset;
  }

  static Machine const& machine() {
    static Machine const built = Machine::read(machine_file("v450"));
    return built;
  }

  std::filesystem::path written(std::string const& name, output::Dataset const& data = dataset) {
    output::write(data, folder / name);
    return folder / name;
  }

  std::string difference(std::filesystem::path const& first, std::string const& second, double interval = 2400.0) {
    return write_difference({first, second, {}, folder / "out", interval});
  }

  inline static output::Dataset dataset;
  TemporaryDirectory folder;
};

TEST_F(Difference, OfARunWithItselfIsNothing) {
  auto const file = written("run.h5");
  EXPECT_THAT(difference(file, file.string()), HasSubstr("4 frames of the difference of every node, 0 K at most"));
  for (char const* frame : {"field_0000.vtu", "field_0003.vtu"}) {
    auto const temperature = cells_of(folder / "out" / frame, "temperature_difference_K", 54);
    EXPECT_EQ(temperature.array().isFinite().select(temperature.array().abs(), 0.0).maxCoeff(), 0.0);
    EXPECT_GT(temperature.array().isFinite().count(), 20);
    auto const moved = cells_of(folder / "out" / frame, "displacement_difference_um", 54);
    EXPECT_EQ(moved.array().isFinite().select(moved.array().abs(), 0.0).maxCoeff(), 0.0);
  }
  for (auto const& [name, value] : points_of(folder / "out/sensors_0003.vtp", "temperature_difference_K"))
    EXPECT_EQ(value, 0.0) << name;
}

/// Two kelvin more everywhere after the first row: the fields differ by that, and by the growth that it makes.
TEST_F(Difference, OfAKnownOffsetIsThatOffset) {
  auto warmer = dataset;
  auto const rows = warmer.time_s.size();
  warmer.node_temperatures->bottomRows(rows - 1).array() += 2.0F;
  for (auto& reading : warmer.readings) reading.values.array() += 0.5;
  difference(written("warmer.h5", warmer), written("run.h5").string());
  auto const last = folder / "out/field_0003.vtu";
  auto const temperature = cells_of(last, "temperature_difference_K", 54);
  Eigen::VectorXd const rise = Eigen::VectorXd::Constant(machine().network().nodes(), 2.0);
  Eigen::Matrix3Xd const grown =
      1e6 * thermal::growth_field(machine().growing, {rise.data(), std::size_t(rise.size())});
  auto const moved = cells_of(last, "displacement_difference_um", 54);
  EXPECT_GT(grown.cwiseAbs().maxCoeff(), 10.0);
  for (Eigen::Index node = 0; node < temperature.size(); ++node) {
    if (!std::isfinite(temperature(node))) continue;
    EXPECT_NEAR(temperature(node), 2.0, 1e-5);
    EXPECT_LT((moved.row(node).transpose() - grown.col(node)).norm(), 1e-3);
  }
  EXPECT_NEAR(cells_of(folder / "out/field_0000.vtu", "temperature_difference_K", 54)(0), 0.0, 1e-12);
  EXPECT_NEAR(points_of(folder / "out/sensors_0003.vtp", "temperature_difference_K").at("T1"), 0.5, 1e-9);
  EXPECT_THAT(tests::contents(folder / "out/arranged.pvsm"), HasSubstr("displacement_difference_um"));
}

/// The second is met between its rows: temperatures that rise evenly are known there exactly.
TEST_F(Difference, IsTakenAtTheFirstsTimes) {
  auto even = dataset;
  for (Eigen::Index r = 0; r < even.time_s.size(); ++r)
    even.node_temperatures->row(r).setConstant(float(20.0 + even.time_s[r] / 600.0));
  auto shifted = even;
  shifted.time_s.array() += 75.0;  // between two rows of the other, and it begins later
  difference(written("even.h5", even), written("shifted.h5", shifted).string(), 600.0);
  EXPECT_THAT(tests::contents(folder / "out/fields.pvd"), HasSubstr("timestep=\"600\""));
  EXPECT_NEAR(cells_of(folder / "out/field_0001.vtu", "temperature_difference_K", 54)(0), 0.125, 1e-5);
  shifted.time_s.array() += 1e5;
  auto const later = written("later.h5", shifted).string();
  EXPECT_THAT([&] { difference(folder / "even.h5", later); },
              ThrowsMessage<InputError>(HasSubstr("no time in common")));
}

TEST_F(Difference, NamesTheFirstBodyThatIsNotTheSame) {
  auto const first = written("run.h5").string();
  auto const of_machine = [&](std::string const& text) {
    auto other = dataset;
    other.provenance["machine.file"] = text;
    return written("other.h5", other).string();
  };
  auto text = text_of_file(machine_file("v450"));
  auto const coarser = of_machine(text.replace(text.find("cells = 21"), 10, "cells = 20"));
  EXPECT_THAT([&] { difference(first, coarser); },
              ThrowsMessage<InputError>(HasSubstr("the body 'shaft' has 21 cells in run.h5 and 20 in other.h5")));
  text.replace(text.find("cells = 20"), 10, "cells = 21").replace(text.find("\"70 mm\""), 7, "\"72 mm\"");
  auto const thicker = of_machine(text);
  EXPECT_THAT([&] { difference(first, thicker); },
              ThrowsMessage<InputError>(HasSubstr("cell 0 of the body 'shaft' is another in run.h5")));
  auto const stranger = of_machine(text_of_file(machine_file("g200")));
  EXPECT_THAT([&] { difference(first, stranger); }, ThrowsMessage<InputError>(HasSubstr("only other.h5 has the body")));
}

/// Without every node the residual at the sensors is carried: at a sensor's cell it is the sensor's.
TEST_F(Difference, OfAMeasurementIsTheResidualAtItsSensors) {
  auto measured = dataset;
  measured.node_temperatures.reset();
  double step = 0.5;
  std::map<std::string, double> expected;
  for (auto& reading : measured.readings) {
    reading.values.array() += step;
    expected[reading.name] = step;
    step += 0.25;
  }
  EXPECT_THAT(difference(written("measured.h5", measured), written("run.h5").string()), HasSubstr("carried"));
  auto const shown = points_of(folder / "out/sensors_0003.vtp", "temperature_residual_K");
  auto const field = cells_of(folder / "out/field_0003.vtu", "temperature_residual_K", 54);
  std::size_t placed = 0;
  for (auto const& sensor : machine().sensors) {
    if (sensor.weights.empty()) continue;
    ++placed;
    EXPECT_NEAR(shown.at(sensor.description.name), expected.at(sensor.description.name), 1e-9);
    double seen = 0.0;
    for (auto const& [node, weight] : sensor.weights) seen += weight * field(node);
    EXPECT_NEAR(seen, expected.at(sensor.description.name), 1e-9) << sensor.description.name;
  }
  EXPECT_EQ(shown.size(), placed);
  EXPECT_TRUE(field.array().isNaN().any());  // bodies that bear no sensor
  EXPECT_EQ(cells_of(folder / "out/field_0003.vtu", "displacement_difference_um", 54).size(), 0);
}

TEST_F(Difference, OfTheSameInOtherUnitsIsNothing) {
  difference(tests::put_in_other_units(dataset, folder), written("run.h5").string());
  auto const shown = points_of(folder / "out/sensors_0003.vtp", "temperature_residual_K");
  EXPECT_GT(shown.size(), 5U);
  for (auto const& [name, value] : shown) EXPECT_NEAR(value, 0.0, 1e-9) << name;
}

/// The twin is a file: it is run through what the measurement went through.
TEST_F(Difference, OfAMeasurementAndAMachineIsWhatTheMachineDoesNotTell) {
  auto ideal = dataset;
  ideal.readings = ideal.truth_readings;
  ideal.node_temperatures.reset();
  ideal.readings[0].values.array() += 3.0;
  ideal.readings[1].values.tail(5).setConstant(std::nan(""));
  difference(written("ideal.h5", ideal), "v450");
  auto const shown = points_of(folder / "out/sensors_0003.vtp", "temperature_residual_K");
  EXPECT_NEAR(shown.at("T1"), 3.0, 0.02);
  EXPECT_FALSE(shown.contains("T2"));  // it shows nothing then
  EXPECT_NEAR(shown.at("T5"), 0.0, 0.02);
  EXPECT_THAT([&] { difference(folder / "ideal.h5", "no_such_machine"); },
              ThrowsMessage<InputError>(HasSubstr("no_such")));
}

/// A bar of ten cells of 10 mm: constant from one sensor, straight between two, constant beyond; their means where they
/// see the same; untouched where there is none.
TEST(ResidualCarrier, IsWhatItSaysOnABar) {
  thermal::BodyGeometry bar{"bar", 3, {}}, other{"other", 13, {}};
  for (int i = 0; i < 10; ++i)
    bar.cells.push_back(thermal::BoxCell{{0.01 * i, 0.0, 0.0}, 0.01 * Eigen::Matrix3d::Identity()});
  other.cells.push_back(thermal::BoxCell{{1.0, 0.0, 0.0}, 0.01 * Eigen::Matrix3d::Identity()});
  NodeWeights const at_2 = {{5, 1.0}}, at_6 = {{9, 1.0}}, whole = {{3, 0.5}, {12, 0.5}}, both = {{4, 0.5}, {13, 0.5}};
  double const none = std::nan("");

  auto const one = ResidualCarrier({bar, other}, {at_2})(Eigen::VectorXd::Constant(1, 1.5));
  EXPECT_LT((one.segment(3, 10).array() - 1.5).abs().maxCoeff(), 1e-12);
  EXPECT_TRUE(one.head(3).array().isNaN().all() && std::isnan(one[13]));

  auto const two = ResidualCarrier({bar, other}, {at_2, at_6})(Eigen::Vector2d(1.0, 3.0));
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(two[3 + i], std::clamp(1.0 + 0.5 * (i - 2), 1.0, 3.0), 1e-12) << i;

  auto const silent = ResidualCarrier({bar, other}, {at_2, at_6})(Eigen::Vector2d(none, 3.0));
  EXPECT_NEAR(silent[5], 3.0, 1e-12);

  auto const three = ResidualCarrier({bar, other}, {at_2, at_6, whole})(Eigen::Vector3d(1.0, 3.0, -2.0));
  EXPECT_NEAR(three[5], 1.0, 1e-12);
  EXPECT_NEAR(three[9], 3.0, 1e-12);
  EXPECT_NEAR(0.5 * (three[3] + three[12]), -2.0, 1e-12);

  auto const same = ResidualCarrier({bar, other}, {at_2, at_2})(Eigen::Vector2d(1.0, 3.0));
  EXPECT_NEAR(same[5], 2.0, 1e-12);

  auto const shared = ResidualCarrier({bar, other}, {both})(Eigen::VectorXd::Constant(1, 0.7));
  EXPECT_NEAR(shared[4], 0.7, 1e-12);
  EXPECT_NEAR(shared[13], 0.7, 1e-12);

  auto const apart = ResidualCarrier({bar, other}, {at_2, both})(Eigen::Vector2d(1.0, 2.0));
  EXPECT_NEAR(apart[5], 1.0, 1e-12);
  EXPECT_NEAR(0.5 * (apart[4] + apart[13]), 2.0, 1e-12);
}

}  // namespace
}  // namespace thermotwin::twin
