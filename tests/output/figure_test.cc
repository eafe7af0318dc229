#include "output/figure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>

#include "output/picture_scale.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using testing::HasSubstr;
using tests::TemporaryDirectory;

constexpr double grain = 1.0 / 256.0;  // pt: what Cairo keeps of a coordinate

struct Point {
  double x, y;
};

/// The pieces of every curve in an SVG: paths with round joints, cut where they begin anew.
std::vector<std::vector<Point>> curves_in(std::string const& svg) {
  static std::regex const path("<path style=\"[^\"]*stroke-linejoin:round[^\"]*\" d=\"([^\"]*)\"");
  std::vector<std::vector<Point>> curves;
  for (std::sregex_iterator it(svg.begin(), svg.end(), path), end; it != end; ++it) {
    std::istringstream text((*it)[1].str());
    std::string letter;
    Point p{};
    while (text >> letter >> p.x >> p.y) {
      if (letter == "M") curves.emplace_back();
      curves.back().push_back(p);
    }
  }
  return curves;
}

Figure two_waves() {
  Figure figure;
  figure.x_label = "Time / h";
  figure.y_label = "Temperature / °C";
  Eigen::VectorXd const x = Eigen::VectorXd::LinSpaced(241, 0.0, 8.0);
  figure.lines = {{"rise", x, (20.0 + 15.0 * (1.0 - (-x.array() / 1.5).exp())).matrix()},
                  {"wave", x, (22.0 + 3.0 * (2.0 * x.array()).sin()).matrix()}};
  set_style(figure.lines[1], 1);
  return figure;
}

double distance(Point p, Point a, Point b) {
  double const length = std::pow(b.x - a.x, 2) + std::pow(b.y - a.y, 2);
  double const share =
      length > 0 ? std::clamp(((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - share * (b.x - a.x), p.y - a.y - share * (b.y - a.y));
}

/// Cairo leaves out corners that lie on the line through their neighbours.
TEST(Figure, EveryNumberLiesOnItsCurveAndEveryCornerIsANumber) {
  TemporaryDirectory const folder;
  auto const figure = two_waves();
  auto const f = write_figure(figure, folder / "two.svg");
  auto const curves = curves_in(tests::contents(folder / "two.svg"));
  ASSERT_EQ(curves.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    auto const &x = figure.lines[k].x, &y = figure.lines[k].y;
    ASSERT_GT(curves[k].size(), 60U);
    std::vector<Point> given;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      given.push_back({f.left + (x[i] - f.x_low) / (f.x_high - f.x_low) * (f.right - f.left),
                       f.bottom - (y[i] - f.y_low) / (f.y_high - f.y_low) * (f.bottom - f.top)});
    for (auto const& p : given) {
      double nearest = 1e9;
      for (std::size_t i = 0; i + 1 < curves[k].size(); ++i)
        nearest = std::min(nearest, distance(p, curves[k][i], curves[k][i + 1]));
      EXPECT_LT(nearest, 1.5 * grain);
    }
    for (auto const& corner : curves[k]) {
      double nearest = 1e9;
      for (auto const& p : given) nearest = std::min(nearest, std::hypot(p.x - corner.x, p.y - corner.y));
      EXPECT_LT(nearest, 1.5 * grain);
    }
  }
}

TEST(Figure, HasTheSizeOfAColumn) {
  TemporaryDirectory const folder;
  auto figure = two_waves();
  for (double const width : {Figure::one_column, Figure::two_columns}) {
    figure.width = width;
    auto const frame = write_figure(figure, folder / "two.svg");
    auto const svg = tests::contents(folder / "two.svg");
    std::smatch size;
    ASSERT_TRUE(std::regex_search(svg, size, std::regex("<svg[^>]* width=\"([0-9.]+)pt\"")));
    EXPECT_NEAR(std::stod(size[1]) * 25.4 / 72.0, width, 0.01);
    EXPECT_LT(frame.right, std::stod(size[1]));
    EXPECT_GT(frame.left, 10.0);
  }
}

TEST(Figure, MissingValuesInterruptACurve) {
  TemporaryDirectory const folder;
  auto figure = two_waves();
  figure.lines.resize(1);
  figure.lines[0].y.segment(100, 20).setConstant(std::nan(""));
  (void)write_figure(figure, folder / "gap.svg");
  auto const curves = curves_in(tests::contents(folder / "gap.svg"));
  ASSERT_EQ(curves.size(), 2U);
  auto const f = write_figure(figure, folder / "gap.svg");
  auto const hours = [&](Point p) { return f.x_low + (p.x - f.left) / (f.right - f.left) * (f.x_high - f.x_low); };
  EXPECT_NEAR(hours(curves[0].front()), 0.0, 0.001);
  EXPECT_NEAR(hours(curves[0].back()), 99.0 / 30.0, 0.001);
  EXPECT_NEAR(hours(curves[1].front()), 120.0 / 30.0, 0.001);
  EXPECT_NEAR(hours(curves[1].back()), 8.0, 0.001);
}

TEST(Figure, TicksAreRoundAndSpanTheData) {
  TemporaryDirectory const folder;
  auto const f = write_figure(two_waves(), folder / "two.svg");
  EXPECT_EQ(f.x_ticks, (std::vector<double>{0, 2, 4, 6, 8}));
  EXPECT_LE(f.y_low, 19.0);
  EXPECT_GE(f.y_high, 34.9);
  EXPECT_EQ(f.y_ticks.front(), f.y_low);
  EXPECT_EQ(f.y_ticks.back(), f.y_high);
}

TEST(Figure, ASpanThatIsSmallForAMachineHasItsOwnTicks) {
  auto const ticks = round_ticks(1.0, 1.003, 0.0);
  EXPECT_NEAR(ticks.step, 0.0005, 1e-12);
}

TEST(Figure, AConstantHasRoomAboutItHoweverLarge) {
  TemporaryDirectory const folder;
  for (double const value : {0.0, 20.0, 2e16, -1e17, 1e300}) {
    Figure figure;
    figure.lines = {{"", Eigen::VectorXd::Constant(1, value), Eigen::VectorXd::Constant(1, value)}};
    auto const f = write_figure(figure, folder / "constant.svg");
    EXPECT_LT(f.y_low, value);
    EXPECT_GT(f.y_high, value);
    EXPECT_LT(f.x_low, value);
    EXPECT_GT(f.x_high, value);
    EXPECT_TRUE(std::adjacent_find(f.y_ticks.begin(), f.y_ticks.end(), std::greater_equal<>()) == f.y_ticks.end());
  }
}

TEST(Figure, RowsStandWithTheirIntervals) {
  TemporaryDirectory const folder;
  Figure figure;
  figure.x_label = "RMSE / µm";
  figure.rows = {{"first", 1.0, 0.8, 1.2}, {"second", 2.0, 2.0, 2.0}};
  auto const f = write_figure(figure, folder / "rows.svg");
  EXPECT_LE(f.x_low, 0.0);
  EXPECT_GE(f.x_high, 2.0);
  EXPECT_EQ(f.y_high, 2.0);
}

TEST(Figure, IsTheSameBytesEveryTime) {
  TemporaryDirectory const folder;
  for (std::string const ending : {".svg", ".pdf"}) {
    (void)write_figure(two_waves(), folder / ("a" + ending));
    (void)write_figure(two_waves(), folder / ("b" + ending));
    EXPECT_TRUE(tests::contents(folder / ("a" + ending)) == tests::contents(folder / ("b" + ending))) << ending;
  }
}

TEST(Figure, RefusesWhatItCannotDraw) {
  TemporaryDirectory const folder;
  auto const refusal = [&](Figure const& figure, std::string const& name) -> std::string {
    try {
      (void)write_figure(figure, folder / name);
    } catch (thermal::InputError const& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_THAT(refusal(two_waves(), "two.png"), HasSubstr(".svg or .pdf"));
  EXPECT_THAT(refusal({}, "none.svg"), HasSubstr("no values"));
  auto huge = two_waves();
  huge.lines[0].y[7] = 1e301;
  EXPECT_THAT(refusal(huge, "huge.svg"), HasSubstr("no scale for numbers beyond 1e+300"));
  auto uneven = two_waves();
  uneven.lines[1].y.conservativeResize(7);
  EXPECT_THAT(refusal(uneven, "uneven.svg"), HasSubstr("'wave' has 241 places and 7 values"));
  auto flat = two_waves();
  flat.height = 12.0;
  EXPECT_THAT(refusal(flat, "flat.svg"), HasSubstr("no room for its axes and its key: a height of 25 mm is due"));
  Figure many;
  for (int i = 0; i < 30; ++i)
    many.rows.push_back({"correlation_grouping 4 + principal_component_distributed_lag", 1.0 + i, 0.5 + i, 1.5 + i});
  EXPECT_THAT(refusal(many, "many.svg"),
              testing::ContainsRegex("a width of [0-9]+ mm and a height of [0-9]+ mm is due"));
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace thermotwin::output
