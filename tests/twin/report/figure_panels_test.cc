#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/twin/report/in_other_units.h"
#include "thermal/error.h"
#include "twin/report/figure_files.h"

namespace thermotwin::twin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::TemporaryDirectory;

/// Three hours, a row a minute; `shift` moves T1.
output::Dataset warm_up(double shift) {
  output::Dataset data;
  data.title = "warm-up";
  data.time_s = Eigen::VectorXd::LinSpaced(181, 0.0, 10800.0);
  Eigen::VectorXd const rise = (1.0 - (-data.time_s.array() / 3600.0).exp()).matrix();
  Eigen::VectorXd const zero = Eigen::VectorXd::Zero(181);
  data.inputs = {{"spindle.speed", "rpm", "", 4000.0 * (data.time_s.array() < 7200.0).cast<double>().matrix()},
                 {"ambient.gradient", "K/m", "", zero}};
  data.readings = {{"T1", "degC", "nose", (20.0 + shift + 10.0 * rise.array()).matrix()},
                   {"T2", "degC", "motor", (20.0 + 25.0 * rise.array()).matrix()}};
  data.displacements = {{"E_Z", "um", "", 40.0 * rise}, {"A", "urad", "", -9.0 * rise}};
  data.heat = {{"bearing", "W", "", 100.0 * rise}, {"idle", "W", "", zero}};
  return data;
}

/// Without the rows between one hour and two.
output::Dataset interrupted(output::Dataset data) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index row = 0; row < data.time_s.size(); ++row)
    if (data.time_s[row] <= 3600.0 || data.time_s[row] >= 7200.0) kept.push_back(row);
  data.time_s = data.time_s(kept).eval();
  for (auto* channels : {&data.inputs, &data.readings, &data.displacements, &data.heat})
    for (auto& channel : *channels) channel.values = channel.values(kept).eval();
  return data;
}

std::vector<std::string> names_of(std::vector<FigurePanel> const& panels) {
  std::vector<std::string> names;
  for (auto const& panel : panels) names.push_back(panel.name);
  return names;
}

output::Figure const& panel(std::vector<FigurePanel> const& panels, std::string const& name) {
  return std::find_if(panels.begin(), panels.end(), [&](auto const& p) { return p.name == name; })->figure;
}

class FigurePanels : public testing::Test {
 protected:
  std::filesystem::path written(std::string const& name, double shift) const {
    output::write(warm_up(shift), folder / name);
    return folder / name;
  }
  std::string refusal(FigureFiles const& files) const {
    try {
      (void)write_figure_files(files);
    } catch (thermal::InputError const& error) {
      return error.what();
    }
    return "nothing";
  }

  TemporaryDirectory folder;
};

TEST_F(FigurePanels, AreThoseOfThePage) {
  EXPECT_THAT(names_of(figure_panels({written("a.h5", 0.0)})),
              ElementsAre("input_rpm", "sensor_temperatures_degC", "displacements_um", "tilt_urad", "heat"));
  EXPECT_THAT(names_of(figure_panels({folder / "a.h5", written("b.h5", 1.0)})),
              ElementsAre("input_rpm", "sensor_temperatures_degC", "residual_sensor_temperatures_degC",
                          "displacements_um", "residual_displacements_um", "tilt_urad", "residual_tilt_urad", "heat"));
}

TEST_F(FigurePanels, DrawNoCounterBesideFlags) {
  auto data = warm_up(0.0);
  Eigen::VectorXd const on = (data.time_s.array() < 7200.0).cast<double>().matrix();
  data.inputs = {{"spindle.running", "1", "", on}, {"spindle.revolutions", "1", "", data.time_s * 70.0}};
  output::write(data, folder / "a.h5");
  auto const panels = figure_panels({folder / "a.h5"});
  auto const& flags = panel(panels, "input_1");
  ASSERT_EQ(flags.lines.size(), 1U);
  EXPECT_EQ(flags.lines[0].name, "spindle.running");
}

TEST_F(FigurePanels, HoldTheNumbersOfTheDataSet) {
  auto const data = warm_up(0.0);
  auto const panels = figure_panels({written("a.h5", 0.0)});
  auto const& figure = panel(panels, "sensor_temperatures_degC");
  ASSERT_EQ(figure.lines.size(), 2U);
  EXPECT_EQ(figure.x_label, "Time / h");
  EXPECT_EQ(figure.y_label, "Temperature / °C");
  EXPECT_TRUE(figure.lines[1].x.isApprox(data.time_s / 3600.0, 1e-12));
  EXPECT_TRUE(figure.lines[1].y.isApprox(data.readings[1].values, 1e-12));
  EXPECT_EQ(panel(panels, "heat").lines.size(), 1U);
}

TEST_F(FigurePanels, ShowOfEveryDataSetWhatItWasGivenOtherwise) {
  EXPECT_EQ(panel(figure_panels({written("a.h5", 0.0), written("b.h5", 1.0)}), "input_rpm").lines.size(), 1U);
  auto data = warm_up(0.0);
  data.inputs[0].values *= 1.5;
  data.heat[0].values *= 1.2;
  output::write(data, folder / "c.h5");
  auto const panels = figure_panels({folder / "a.h5", folder / "b.h5", folder / "c.h5"});
  auto const& speeds = panel(panels, "input_rpm").lines;
  ASSERT_EQ(speeds.size(), 3U);
  EXPECT_EQ(speeds[2].name, "spindle.speed, c");
  EXPECT_DOUBLE_EQ(speeds[2].y.maxCoeff(), 6000.0);
  EXPECT_NEAR(panel(panels, "heat_c").lines[0].y[180] / panel(panels, "heat_a").lines[0].y[180], 1.2, 1e-6);
}

TEST_F(FigurePanels, ResidualIsTheFirstLessTheOther) {
  auto const panels = figure_panels({written("a.h5", 0.0), written("b.h5", 1.5)});
  EXPECT_EQ(panel(panels, "residual_sensor_temperatures_degC").y_label, "a − b / K");
  auto const& lines = panel(panels, "residual_sensor_temperatures_degC").lines;
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE((lines[0].y.array() + 1.5).abs().maxCoeff() < 1e-9);
  EXPECT_LT(lines[1].y.cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(FigurePanels, TheSameInOtherUnitsIsTheSame) {
  auto const other = tests::put_in_other_units(warm_up(0.0), folder);
  auto const panels = figure_panels({other, written("a.h5", 0.0)});
  EXPECT_THAT(names_of(panels),
              ElementsAre("input_rpm", "sensor_temperatures_degC", "residual_sensor_temperatures_degC",
                          "displacements_um", "residual_displacements_um", "tilt_urad", "residual_tilt_urad", "heat"));
  for (char const* name : {"residual_sensor_temperatures_degC", "residual_displacements_um", "residual_tilt_urad"}) {
    ASSERT_FALSE(panel(panels, name).lines.empty()) << name;
    for (auto const& line : panel(panels, name).lines) EXPECT_LT(line.y.cwiseAbs().maxCoeff(), 1e-9) << name;
  }
}

/// Whether a curve is drawn at x.
bool is_drawn(output::FigureLine const& line, double x) {
  for (Eigen::Index i = 1; i < line.x.size(); ++i)
    if (line.x[i - 1] <= x && x <= line.x[i] && std::isfinite(line.y[i - 1]) && std::isfinite(line.y[i])) return true;
  return false;
}

/// Neither a course nor a residual goes through an hour without rows; a value that is set does not hold for it.
TEST_F(FigurePanels, WhereRowsAreFarApartCurvesAreInterrupted) {
  output::write(interrupted(warm_up(0.0)), folder / "gap.h5");
  auto const panels = figure_panels({folder / "gap.h5"});
  for (char const* name : {"input_rpm", "sensor_temperatures_degC", "displacements_um", "heat"}) {
    auto const& line = panel(panels, name).lines[0];
    for (double const hours : {0.5, 0.99, 2.01, 2.5}) EXPECT_TRUE(is_drawn(line, hours)) << name << hours;
    for (double const hours : {1.01, 1.3, 1.7, 1.99}) EXPECT_FALSE(is_drawn(line, hours)) << name << hours;
  }
  auto const against = figure_panels({written("a.h5", 0.0), folder / "gap.h5"});
  EXPECT_TRUE(is_drawn(panel(against, "residual_displacements_um").lines[0], 0.5));
  EXPECT_FALSE(is_drawn(panel(against, "residual_displacements_um").lines[0], 1.5));
  EXPECT_TRUE(is_drawn(panel(against, "sensor_temperatures_degC").lines[0], 1.5));
}

TEST_F(FigurePanels, RunsHaveTheirDashesAndOfOneChannelTheirColours) {
  std::vector<std::filesystem::path> const files = {written("a.h5", 0.0), written("b.h5", 1.5), written("c.h5", 0.5)};
  auto const panels = figure_panels(files);
  auto const& lines = panel(panels, "residual_sensor_temperatures_degC").lines;
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].name, "T1, a − b");
  EXPECT_EQ(lines[2].name, "T1, a − c");
  EXPECT_EQ(lines[0].colour, lines[2].colour);
  EXPECT_NE(lines[0].dashes, lines[2].dashes);
  EXPECT_EQ(lines[0].dashes, panel(panels, "sensor_temperatures_degC").lines[2].dashes);
  EXPECT_THAT(write_figure_files({files, "residual_sensor_temperatures_degC", {"T1"}, folder / "gap.svg"}),
              HasSubstr("gap.svg"));
  EXPECT_THAT(
      tests::contents(folder / "gap.svg"),
      testing::AllOf(HasSubstr("rgb(0%,45%,70%)"), HasSubstr("rgb(84%,37%,0%)"), HasSubstr("stroke-dasharray")));
}

TEST_F(FigurePanels, WhatIsSetHoldsUntilTheNextRow) {
  auto const panels = figure_panels({written("a.h5", 0.0)});
  auto const& line = panel(panels, "input_rpm").lines[0];
  ASSERT_EQ(line.x.size(), 361);
  for (Eigen::Index i = 0; i + 1 < line.x.size(); ++i)
    EXPECT_TRUE(line.x[i] == line.x[i + 1] || line.y[i] == line.y[i + 1]) << i;
}

TEST_F(FigurePanels, WaysOfAPassAreToldApartByDashes) {
  auto data = warm_up(0.0);
  data.positioning = {{"z", Eigen::Vector3d(0.0, 100.0, 200.0), Eigen::Vector2d(0.0, 3600.0),
                       Eigen::MatrixXd::Zero(2, 3), Eigen::MatrixXd::Ones(2, 3)}};
  output::write(data, folder / "feed.h5");
  auto const panels = figure_panels({folder / "feed.h5"});
  auto const& lines = panel(panels, "positioning_feed_z").lines;
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].name, "forward, 0 s");
  EXPECT_EQ(lines[3].name, "backward, 1 h 00 min");
  EXPECT_TRUE(lines[0].dashes.empty());
  EXPECT_FALSE(lines[3].dashes.empty());
}

TEST_F(FigurePanels, OfAnUnknownHeatTheBandHolds95Percent) {
  tests::put(folder / "d.json", R"({"verdict": "none_known", "heat": {"body": "motor", "watts": 10, "runs": [
    {"time_s": [0, 3600, 7200], "watts": [0, 10, 20], "standard_error": [1, 2, 3]}]}})");
  auto const panels = figure_panels({folder / "d.json"});
  auto const& figure = panel(panels, "unknown_heat");
  ASSERT_EQ(figure.bands.size(), 1U);
  EXPECT_NEAR(figure.bands[0].high[2], 20.0 + 1.96 * 3.0, 1e-9);
  EXPECT_NEAR(figure.bands[0].low[0], -1.96, 1e-9);
}

TEST_F(FigurePanels, RankingHasTheBestFirst) {
  tests::put(folder / "study.json", R"({"worlds": [{"name": "w", "unit": "um"}], "combinations": [
    {"world": "w", "selection": "all", "model": "linear", "figures": {"cross.rmse": {"mean": 3, "half_width_95": 1}}},
    {"world": "w", "selection": "two", "model": "linear", "figures": {"cross.rmse": {"mean": 1, "half_width_95": 0.5}}},
    {"world": "w", "selection": "no", "model": "linear", "figures": {}}]})");
  auto const panels = figure_panels({folder / "study.json"});
  auto const& rows = panel(panels, "ranking_w").rows;
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].name, "two + linear");
  EXPECT_EQ(rows[0].low, 0.5);
}

TEST_F(FigurePanels, TellFilesOfOneNameApart) {
  for (auto const* name : {"a", "b"}) std::filesystem::create_directory(folder / name);
  EXPECT_THAT(write_figure_files({{written("a/run.h5", 0.0), written("b/run.h5", 1.0)}, "", {}, ""}),
              HasSubstr("T1, T2 (of a/run, b/run)\n"));
}

TEST_F(FigurePanels, AreChosenByNameAndTheirCurves) {
  auto const path = written("a.h5", 0.0);
  EXPECT_THAT(write_figure_files({{path}, "", {}, ""}), HasSubstr("sensor_temperatures_degC           T1, T2\n"));
  EXPECT_THAT(write_figure_files({{path, written("b.h5", 1.0)}, "", {}, ""}),
              testing::AllOf(HasSubstr("\nsensor_temperatures_degC           T1, T2 (of a, b)\n"),
                             HasSubstr("\nresidual_sensor_temperatures_degC  T1, T2\n")));
  EXPECT_THAT(write_figure_files({{path}, "heat", {}, folder / "heat.pdf"}), HasSubstr("84 mm by 56 mm"));
  EXPECT_THAT(refusal({{path}, "heats", {}, folder / "x.svg"}), HasSubstr("they have input_rpm, sensor_"));
  EXPECT_THAT(refusal({{path}, "heat", {"T1"}, folder / "x.svg"}), HasSubstr("the panel 'heat' has no curve 'T1'; "));
  EXPECT_THAT(refusal({{path}, "sensor_temperatures_degC", {"T1", "T22"}, folder / "x.svg"}),
              HasSubstr("no curve 'T22'; did you mean 'T2'?"));
  EXPECT_THAT(refusal({{path}, "heat", {}, path}), HasSubstr("a.h5"));
  tests::put(folder / "progress.json", R"({"title": "Study", "steps": [], "done": false})");
  for (auto const& [name, output] : {std::pair{"", ""}, {"heat", "x.svg"}})
    EXPECT_THAT(refusal({{folder / "progress.json"}, name, {}, output}), HasSubstr("have no panel that could be"));
  EXPECT_FALSE(std::filesystem::exists(folder / "x.svg"));
}

}  // namespace
}  // namespace thermotwin::twin
