#include "output/fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/error.h"
#include "output/field_mesh.h"
#include "tests/output/example_geometry.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
using testing::UnorderedElementsAre;
using tests::block;
using tests::contents;
using tests::cylinder;
using tests::put;
using tests::TemporaryDirectory;
using thermal::Geometry;
using thermal::InputError;

Eigen::Vector3d const origin = Eigen::Vector3d::Zero();

Geometry small_machine() {
  return {block("bed <1>", 0, origin, {0.4, 0.3, 0.2}, {2, 2, 1}),
          cylinder("Hülse", 4, {{0, 0, 0.5}, Eigen::Vector3d::UnitY(), 0.3, 0.05, 0.1}, 2, 1),
          cylinder("shaft", 6, {{0, 0, 0.5}, Eigen::Vector3d::UnitY(), 0.3, 0.0, 0.04}, 3, 1)};
}

Frame frame_at(double level) {
  Frame frame;
  frame.temperature_degC = Eigen::VectorXd::LinSpaced(9, level, level + 8.0);
  frame.heat_source_W = Eigen::VectorXd::LinSpaced(9, 0.0, 80.0);
  frame.displacement_m = 1e-6 * Eigen::Matrix3Xd::Random(3, 9);
  return frame;
}

TEST(Fields, AreReadBackByVtk) {
  TemporaryDirectory const directory;
  Geometry const geometry = small_machine();
  Frame const frame = frame_at(22.0);
  FieldSeries series(directory / "fields", geometry, {22.0, {{"machine", "small"}, {"seed", "7"}}});
  series.add(0.0, frame_at(22.0));
  series.add(600.5, frame);
  FieldSummary const field = read_field(directory / "fields/field_0001.vtu");

  EXPECT_EQ(field.time_s, 600.5);
  EXPECT_THAT(field.metadata, ElementsAre(std::pair("machine", "small"), std::pair("seed", "7")));
  EXPECT_THAT(field.body_names, ElementsAre("bed <1>", "Hülse", "shaft"));
  ASSERT_EQ(field.node.size(), 4 + 5 * FieldMesh::segments);
  Eigen::VectorXd const node_volumes = FieldMesh(geometry).node_volumes();
  for (Eigen::Index i = 0; i < field.node.size(); ++i) {
    int const node = field.node[i];
    EXPECT_EQ(field.temperature_degC[i], frame.temperature_degC[node]);
    EXPECT_EQ(field.temperature_rise_K[i], frame.temperature_degC[node] - 22.0);
    EXPECT_DOUBLE_EQ(field.heat_source_W_per_m3[i], frame.heat_source_W[node] / node_volumes[node]);
    EXPECT_TRUE(field.displacement_um.col(i).isApprox(1e6 * frame.displacement_m.col(node)));
    EXPECT_EQ(field.body[i], node < 4 ? 0 : node < 6 ? 1 : 2);
    EXPECT_EQ(field.body_name[static_cast<std::size_t>(i)], field.body_names[static_cast<std::size_t>(field.body[i])]);
  }
}

TEST(Fields, HaveTheVolumeOfTheGeometry) {
  TemporaryDirectory const directory;
  Geometry geometry = small_machine();
  auto& mirrored = std::get<thermal::BoxCell>(geometry[0].cells[0]);  // left-handed edges are the same box
  mirrored.corner += mirrored.edges.col(0);
  mirrored.edges.col(0) *= -1;
  FieldSeries(directory.path(), geometry).add(0.0, frame_at(20.0));
  FieldSummary const field = read_field(directory / "field_0000.vtu");
  EXPECT_GT(field.volume_m3.minCoeff(), 0.0);
  for (auto const& body : geometry)
    for (std::size_t i = 0; i < body.cells.size(); ++i) {
      int const node = body.first_node + static_cast<int>(i);
      double const expected = thermal::volume(body.cells[i]);
      EXPECT_NEAR((field.node.array() == node).select(field.volume_m3, 0.0).sum(), expected, 1e-12 * expected);
    }
  // Power: density times volume, over all cells, is what went in.
  EXPECT_NEAR(field.heat_source_W_per_m3.dot(field.volume_m3), frame_at(20.0).heat_source_W.sum(), 1e-9);
}

TEST(Fields, SensorsAreASecondSeriesAndAStateArrangesBoth) {
  TemporaryDirectory const directory;
  FieldOptions options;
  options.sensors = {{"T1", {0.1, 0.2, 0.3}}, {"T2", {0.0, 0.0, 0.5}}};
  FieldSeries series(directory.path(), small_machine(), options);
  auto frame = frame_at(22.0);
  frame.sensor_degC = Eigen::Vector2d(23.25, 24.5);
  series.add(0.0, frame);
  series.add(60.0, frame);
  EXPECT_THAT(contents(directory / "sensors.pvd"), HasSubstr("timestep=\"60\" part=\"0\" file=\"sensors_0001.vtp\""));
  auto const points = contents(directory / "sensors_0001.vtp");
  for (char const* part : {"NumberOfPoints=\"2\"", "23.25 24.5", "0.1 0.2 0.3"}) EXPECT_THAT(points, HasSubstr(part));
  auto const state = contents(directory / "arranged.pvsm");
  EXPECT_THAT(state, HasSubstr((directory / "fields.pvd").string()));
  EXPECT_THAT(state, HasSubstr((directory / "sensors.pvd").string()));
  EXPECT_THAT(state, HasSubstr("displacement_um"));
  EXPECT_THAT(state, HasSubstr("Temperature / °C"));
  for (char const* property : {"TimeSources\" number_of_elements=\"2\"",
                               "EndTime\" number_of_elements=\"1\"><Element index=\"0\" value=\"60\""})
    EXPECT_THAT(state, HasSubstr(property));  // without these ParaView plays no times
  frame.sensor_degC.resize(1);
  EXPECT_THAT([&] { series.add(120.0, frame); }, ThrowsMessage<InputError>(HasSubstr("1 temperatures for 2 sensors")));
}

TEST(Fields, WarpContinuouslyWithinABody) {
  TemporaryDirectory const directory;
  Geometry const geometry = {block("bar", 0, origin, {1.0, 0.1, 0.1}, {10, 1, 1})};
  Frame frame;
  frame.temperature_degC = Eigen::VectorXd::Constant(10, 30.0);
  frame.displacement_m = Eigen::Matrix3Xd::Zero(3, 10);
  frame.displacement_m.row(0) = 1e-4 * tests::centres(geometry).row(0);
  FieldSeries(directory.path(), geometry).add(0.0, frame);
  FieldSummary const field = read_field(directory / "field_0000.vtu");
  EXPECT_EQ(field.points_m.cols(), 44);
  EXPECT_LT((field.point_displacement_um.row(0) - 100.0 * field.points_m.row(0)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(field.heat_source_W_per_m3, Eigen::VectorXd::Zero(10));
}

TEST(Fields, AreNamedWithTheirTimes) {
  TemporaryDirectory const directory;
  FieldSeries series(directory.path(), small_machine());
  series.add(0.0, frame_at(20.0));
  series.add(0.1, frame_at(21.0));
  EXPECT_THAT(directory.files(),
              UnorderedElementsAre("fields.pvd", "arranged.pvsm", "field_0000.vtu", "field_0001.vtu"));
  EXPECT_EQ(contents(series.index_path()),
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
            "  <Collection>\n"
            "    <DataSet timestep=\"0\" part=\"0\" file=\"field_0000.vtu\"/>\n"
            "    <DataSet timestep=\"0.1\" part=\"0\" file=\"field_0001.vtu\"/>\n"
            "  </Collection>\n"
            "</VTKFile>\n");
}

TEST(Fields, SameFrameSameBytes) {
  TemporaryDirectory const directory;
  Frame const frame = frame_at(20.0);
  FieldSeries(directory / "a", small_machine()).add(60.0, frame);
  FieldSeries(directory / "b", small_machine()).add(60.0, frame);
  EXPECT_TRUE(contents(directory / "a/field_0000.vtu") == contents(directory / "b/field_0000.vtu"));
}

TEST(Fields, RefuseWhatDoesNotFit) {
  TemporaryDirectory const directory;
  EXPECT_THAT([&] { FieldSeries(directory / "none", Geometry{}); }, ThrowsMessage<InputError>(HasSubstr("none")));
  FieldSeries series(directory.path(), small_machine());
  Frame narrow = frame_at(20.0);
  narrow.temperature_degC.conservativeResize(8);
  EXPECT_THAT([&] { series.add(0.0, narrow); },
              ThrowsMessage<InputError>(HasSubstr("8 temperatures for nodes, but the geometry shows 9")));
  Frame still = frame_at(20.0);
  still.displacement_m.conservativeResize(3, 1);
  EXPECT_THAT([&] { series.add(0.0, still); }, ThrowsMessage<InputError>(HasSubstr("displacements")));
  EXPECT_TRUE(directory.files().empty());
}

TEST(Fields, SayWhatIsInTheWay) {
  TemporaryDirectory const directory;
  put(directory / "file", "");
  EXPECT_THAT([&] { FieldSeries(directory / "file/fields", small_machine()); },
              ThrowsMessage<OutputError>(HasSubstr("Not a directory")));
  put(directory / "field.vtu", "<VTKFile>");
  EXPECT_THAT([&] { static_cast<void>(read_field(directory / "field.vtu")); },
              ThrowsMessage<InputError>(HasSubstr("field.vtu' cannot be read as a field")));
}

}  // namespace
}  // namespace thermotwin::output
