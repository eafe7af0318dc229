#include "output/picture.h"

#include <array>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "output/error.h"
#include "tests/output/example_geometry.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::contents;
using tests::TemporaryDirectory;

/// Removes or changes DISPLAY for a while.
class Display {
 public:
  explicit Display(char const* name) {
    if (char const* const before = std::getenv("DISPLAY")) before_ = before;
    set(name);
  }
  ~Display() { set(before_ ? before_->c_str() : nullptr); }
  Display(Display const&) = delete;
  Display& operator=(Display const&) = delete;

 private:
  static void set(char const* name) { name ? setenv("DISPLAY", name, 1) : unsetenv("DISPLAY"); }
  std::optional<std::string> before_;
};

thermal::Geometry const& machine() {
  static thermal::Geometry const geometry = tests::machine();
  return geometry;
}

/// The machine warms from foot to head, 20 to 40 °C, and leans forward.
Frame leaning_frame() {
  Eigen::Matrix3Xd const centres = tests::centres(machine());
  Frame frame;
  frame.temperature_degC = 20.0 + 10.0 * centres.row(2).transpose().array();
  frame.displacement_m = Eigen::Matrix3Xd::Zero(3, centres.cols());
  frame.displacement_m.row(1) = -2e-5 * centres.row(2);
  return frame;
}

TEST(Picture, SaysThatItNeedsADisplay) {
  TemporaryDirectory const directory;
  {
    Display const none(nullptr);
    EXPECT_THAT([&] { render_picture(machine(), leaning_frame(), directory / "a.png"); },
                ThrowsMessage<OutputError>(AllOf(HasSubstr("DISPLAY is not set"), HasSubstr("run under xvfb-run"))));
  }
  Display const dead(":4711");
  EXPECT_THAT([&] { render_picture(machine(), leaning_frame(), directory / "a.png"); },
              ThrowsMessage<OutputError>(AllOf(HasSubstr("':4711' does not answer"), HasSubstr("xvfb-run"))));
  EXPECT_TRUE(directory.files().empty());
}

TEST(Picture, RefusesWhatDoesNotFit) {
  TemporaryDirectory const directory;
  EXPECT_THAT([&] { render_picture({}, leaning_frame(), directory / "a.png"); },
              ThrowsMessage<thermal::InputError>(HasSubstr("the machine has none")));
  Frame empty;
  EXPECT_THAT([&] { render_picture(machine(), empty, directory / "a.png"); },
              ThrowsMessage<thermal::InputError>(HasSubstr("0 temperatures")));
}

class PictureOnDisplay : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no DISPLAY; run under xvfb-run";
  }

  using Pixel = std::array<int, 3>;

  void draw(Frame const& frame, PictureOptions const& options = {}) {
    render_picture(machine(), frame, directory_ / "a.png", options);
    reader_->SetFileName((directory_ / "a.png").c_str());
    reader_->Modified();
    reader_->Update();
    image_ = reader_->GetOutput();
  }

  /// From the left and from the top.
  Pixel pixel(int x, int y) const {
    Pixel found{};
    int const from_bottom = image_->GetDimensions()[1] - 1 - y;
    for (int i = 0; i < 3; ++i)
      found[static_cast<std::size_t>(i)] = static_cast<int>(image_->GetScalarComponentAsDouble(x, from_bottom, 0, i));
    return found;
  }

  static bool is_near(Pixel const& a, Pixel const& b, int tolerance) {
    return std::abs(a[0] - b[0]) <= tolerance && std::abs(a[1] - b[1]) <= tolerance &&
           std::abs(a[2] - b[2]) <= tolerance;
  }

  int count(Pixel const& colour, int tolerance) const {
    int n = 0;
    for (int x = 0; x < image_->GetDimensions()[0]; ++x)
      for (int y = 0; y < image_->GetDimensions()[1]; ++y) n += is_near(pixel(x, y), colour, tolerance);
    return n;
  }

  /// Pixels of upright thin lines on white, below the title and left of the colour bar.
  int count_lines_on_white() const {
    int n = 0;
    for (int x = 50; x < image_->GetDimensions()[0] * 3 / 4; ++x)
      for (int y = image_->GetDimensions()[1] / 5; y < image_->GetDimensions()[1]; ++y)
        n += pixel(x, y) != white && pixel(x - 2, y) == white && pixel(x + 2, y) == white;
    return n;
  }

  static constexpr Pixel violet = {68, 1, 84}, yellow = {253, 231, 37}, white = {255, 255, 255}, red = {219, 38, 38};

  TemporaryDirectory directory_;
  vtkNew<vtkPNGReader> reader_;
  vtkImageData* image_ = nullptr;
};

TEST_F(PictureOnDisplay, ShowsColdFeetAndAWarmHead) {
  draw(leaning_frame());
  EXPECT_THAT(directory_.files(), ElementsAre("a.png"));
  EXPECT_EQ(image_->GetDimensions()[0], 1600);
  EXPECT_EQ(image_->GetDimensions()[1], 1000);
  double const paper = count(white, 0) / 1.6e6;
  EXPECT_GT(paper, 0.4);
  EXPECT_LT(paper, 0.85);
  // The colour bar: yellow above violet, at its ends.
  EXPECT_TRUE(is_near(pixel(1600 - 163, 205), yellow, 12));
  EXPECT_TRUE(is_near(pixel(1600 - 163, 830), violet, 12));
  // The machine: its column's top is warmer (greener) than its bed's front.
  auto const bed = pixel(500, 800), column = pixel(780, 200);
  EXPECT_FALSE(is_near(bed, white, 60));
  EXPECT_FALSE(is_near(column, white, 60));
  EXPECT_GT(column[1], bed[1] + 40);
}

TEST_F(PictureOnDisplay, MagnifiesTheDeformation) {
  PictureOptions options;
  options.width = 800;
  options.height = 500;
  Frame still = leaning_frame();
  still.displacement_m.resize(3, 0);
  draw(still, options);
  int const before = count_lines_on_white();
  draw(leaning_frame(), options);
  EXPECT_GT(count_lines_on_white(), before + 100) << "the shape at rest stands beside the deformed one";
  std::string const automatic = contents(directory_ / "a.png");
  options.magnification = 2000.0;  // 5 % of 2.69 m over 4.0e-5 m is 3,400
  draw(leaning_frame(), options);
  EXPECT_TRUE(contents(directory_ / "a.png") == automatic);
}

TEST_F(PictureOnDisplay, MarksSensorsInFrontOfEverything) {
  PictureOptions options;
  draw(leaning_frame(), options);
  int const before = count(red, 40);
  options.sensors = {{"T1", {0.3, 0.35, 1.2}}, {"inside", {0.0, 0.3, 1.0}}};
  draw(leaning_frame(), options);
  EXPECT_EQ(before, 0);
  EXPECT_GT(count(red, 40), 2 * 60);
}

TEST_F(PictureOnDisplay, SameFrameSameBytes) {
  PictureOptions const options{
      .width = 400, .height = 250, .title = "v450", .time_s = 60.0, .remark = {}, .magnification = {}, .sensors = {}};
  draw(leaning_frame(), options);
  std::string const first = contents(directory_ / "a.png");
  draw(leaning_frame(), options);
  EXPECT_TRUE(contents(directory_ / "a.png") == first);
}

TEST_F(PictureOnDisplay, SaysThatTheFileCannotBeWritten) {
  EXPECT_THAT([&] { render_picture(machine(), leaning_frame(), directory_ / "no/a.png"); },
              ThrowsMessage<OutputError>(HasSubstr("No such file or directory")));
}

}  // namespace
}  // namespace thermotwin::output
