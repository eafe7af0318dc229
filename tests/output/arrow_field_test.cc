#include "output/arrow_field.h"

#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLStructuredGridReader.h>

#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::TemporaryDirectory;

/// 3 × 2 × 2 points in a box of 200 × 100 × 50 mm; arrows along x that grow with x, and none.
ArrowField example() {
  ArrowField field{{3, 2, 2}, Eigen::Matrix3Xd(3, 12), {}};
  for (int i = 0; i < 12; ++i)
    field.positions.col(i) = Eigen::Vector3d(0.1 * (i % 3), 0.1 * (i / 3 % 2), 0.05 * (i / 6));
  Eigen::Matrix3Xd vectors = Eigen::Matrix3Xd::Zero(3, 12);
  vectors.row(0) = 100.0 * field.positions.row(0);
  field.vectors = {{"error_um", vectors}, {"nothing_um", Eigen::Matrix3Xd::Zero(3, 12)}};
  return field;
}

TEST(ArrowField, OpensAsAStructuredGrid) {
  TemporaryDirectory const directory;
  write_arrows(example(), directory / "field.vts");
  vtkNew<vtkXMLStructuredGridReader> reader;
  reader->SetFileName((directory / "field.vts").c_str());
  reader->Update();
  auto& grid = *reader->GetOutput();
  ASSERT_EQ(grid.GetNumberOfPoints(), 12);
  EXPECT_EQ(grid.GetDimensions()[0], 3);
  auto* const arrows = grid.GetPointData()->GetArray("error_um");
  ASSERT_NE(arrows, nullptr);
  ASSERT_NE(grid.GetPointData()->GetArray("nothing_um"), nullptr);
  EXPECT_DOUBLE_EQ(arrows->GetComponent(5, 0), 20.0);
  EXPECT_DOUBLE_EQ(grid.GetPoint(5)[0], 0.2);
  EXPECT_DOUBLE_EQ(grid.GetPoint(5)[1], 0.1);
}

TEST(ArrowField, RefusesWhatDoesNotFit) {
  TemporaryDirectory const directory;
  auto field = example();
  field.vectors[1].second.resize(3, 5);
  EXPECT_THAT([&] { write_arrows(field, directory / "a.vts"); },
              ThrowsMessage<thermal::InputError>(HasSubstr("'nothing_um' has 5 vectors for 12 points")));
  field.points = {3, 2, 1};
  EXPECT_THAT([&] { write_arrows(field, directory / "a.vts"); },
              ThrowsMessage<thermal::InputError>(HasSubstr("has 12 positions")));
  EXPECT_TRUE(directory.files().empty());
}

/// The long arrows are yellow, at the right end of the box; the panel of nothing stays empty.
TEST(ArrowField, PictureShowsTheLongArrows) {
  if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no DISPLAY; run under xvfb-run";
  TemporaryDirectory const directory;
  render_arrows(example(), directory / "a.png", {.title = "arrows", .shown = {"error_um", "nothing_um"}});
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((directory / "a.png").c_str());
  reader->Update();
  auto& image = *reader->GetOutput();
  ASSERT_EQ(image.GetDimensions()[0], 1800);
  int left = 0, right = 0;
  for (int x = 0; x < 1548; ++x)  // the colour bar stands at the right
    for (int y = 0; y < 1000; ++y) {
      bool const yellow =
          image.GetScalarComponentAsDouble(x, y, 0, 0) > 200 && image.GetScalarComponentAsDouble(x, y, 0, 2) < 120;
      (x < 774 ? left : right) += yellow;
    }
  EXPECT_GT(left, 200);
  EXPECT_EQ(right, 0);
  EXPECT_THAT([&] { render_arrows(example(), directory / "b.png", {.shown = {"error_mm"}}); },
              ThrowsMessage<thermal::InputError>(HasSubstr("no 'error_mm'")));
}

}  // namespace
}  // namespace thermotwin::output
