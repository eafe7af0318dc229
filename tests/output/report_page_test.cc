#include "output/report_page.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/output/page_reader.h"

namespace thermotwin::output {
namespace {

using tests::PageReader;

TEST(ReportPage, GivesBackItsNumbersRowByRow) {
  ReportPage page("numbers", "test");
  Eigen::MatrixXd table(2, 3);
  table << 1.5, -2.25, 1e6, 0.125, std::numeric_limits<double>::quiet_NaN(), 4.0;
  Json const first = page.add_numbers(Eigen::VectorXd::LinSpaced(5, 0.0, 4.0));
  Json const second = page.add_numbers(table);
  Json const third = page.add_whole_numbers({7, -1, 300000});
  page.add_section("numbers", {{"first", first}, {"second", second}, {"third", third}});

  PageReader const read(page.html());
  auto const& section = read.document["sections"][0];
  EXPECT_EQ(section["kind"], "numbers");
  EXPECT_EQ(read.numbers<float>(section["first"]), (std::vector<float>{0, 1, 2, 3, 4}));
  auto const values = read.numbers<float>(section["second"]);
  EXPECT_EQ(section["second"]["shape"], (std::vector<int>{2, 3}));
  EXPECT_EQ(values[2], 1e6F);
  EXPECT_EQ(values[3], 0.125F);
  EXPECT_TRUE(std::isnan(values[4]));
  EXPECT_EQ(read.numbers<std::int32_t>(section["third"]), (std::vector<std::int32_t>{7, -1, 300000}));
}

TEST(ReportPage, QuantisesEachColumnToItsSpan) {
  ReportPage page("quantised", "test");
  Eigen::MatrixXd columns(50, 3);
  for (Eigen::Index i = 0; i < 50; ++i) columns.row(i) << 40.0 * std::sin(0.3 * double(i)), 1e-6 * double(i), 0.0;
  page.add_section("quantised", {{"columns", page.add_quantised(columns)}});

  PageReader const read(page.html());
  auto const& reference = read.document["sections"][0]["columns"];
  auto const whole = read.numbers<std::int16_t>(reference);
  for (Eigen::Index k = 0; k < 3; ++k) {
    double const scale = reference["scales"][std::size_t(k)], span = columns.col(k).cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < 50; ++i)
      EXPECT_NEAR(scale * whole[std::size_t(50 * k + i)], columns(i, k), span / 65534 * 1.0001);
  }
}

TEST(ReportPage, CannotBeEndedByItsText) {
  std::string const title = "</script><script>alert(1)</script> & \"ü\"";
  PageReader const read(ReportPage(title, "test").html());
  EXPECT_EQ(read.document["title"], title);
  EXPECT_EQ(ReportPage(title, "test").html().find("<script>alert"), std::string::npos);
}

TEST(ReportPage, AsksNothingOfAnyNetwork) {
  auto const html = ReportPage("whole", "test").html();
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  for (char const* outside : {"src=\"", "href=\"", "@import", "url(http"})
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
}

TEST(ReportPage, IsTheSameBytesEveryTime) {
  auto const once = [] {
    ReportPage page("same", "test");
    page.add_section("runs", {{"time", page.add_numbers(Eigen::VectorXd::LinSpaced(1000, 0.0, 3600.0))}});
    return page.html();
  };
  EXPECT_TRUE(once() == once());
}

}  // namespace
}  // namespace thermotwin::output
