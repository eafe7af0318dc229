#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

// The architecture of this tree, checked: layers point one way, each foreign library enters through one seam, and the
// root holds nothing unexpected.

namespace thermotwin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using Violations = std::vector<std::string>;

/// Which of our folders a folder may include, besides itself.
std::map<std::string, std::set<std::string>> const layers = {
    {"thermal", {}},
    {"models", {}},
    {"scenarios", {"thermal"}},
    {"output", {"scenarios", "models", "thermal"}},
    {"twin", {"output", "scenarios", "models", "thermal"}},
};

/// A foreign library: how its headers look, and the one place whose files may include them.
struct Seam {
  std::string library;
  std::regex header;
  std::regex place;
};

std::vector<Seam> const seams = {
    {"SUNDIALS", std::regex("(sundials|cvodes|nvector|sunmatrix|sunlinsol|sunnonlinsol)/.*"),
     std::regex("thermal/sundials[^/]*\\.(h|cc)")},
    {"KLU", std::regex("(suitesparse/)?(klu|cs|cholmod|umfpack)\\.h"), std::regex("thermal/linear_factors\\.cc")},
    {"LIBSVM", std::regex("(libsvm/)?svm\\.h"), std::regex("models/support_vector\\.cc")},
    {"HDF5", std::regex("(hdf5|H5).*"), std::regex("output/hdf5[^/]*\\.cc")},
    {"VTK", std::regex("vtk.*"), std::regex("output/vtk[^/]*\\.cc")},
    {"toml++", std::regex("toml(\\+\\+|plusplus).*"), std::regex("twin/file/toml[^/]*\\.cc")},
    {"zlib", std::regex("zlib\\.h"), std::regex("output/(report_page|checksum)\\.cc")},
    {"CLI11", std::regex("CLI/.*"), std::regex("twin/(main|command_line[^/]*)\\.cc")},
    {"Ceres", std::regex("(ceres|glog)/.*"), std::regex("twin/diagnosis/least_squares\\.cc")},
    {"Paho MQTT", std::regex("mqtt/.*"), std::regex("twin/compensation/broker\\.cc")},
    {"Cairo", std::regex("cairo.*"), std::regex("output/cairo[^/]*\\.cc")},
    {"cpp-httplib", std::regex("httplib\\.h"), std::regex("output/page_server\\.cc")},
};

std::set<std::string> const root_entries = {
    ".ci",          ".clang-format",  ".clang-tidy",       ".editorconfig", ".git",   ".gitignore", ".github",
    "CHANGELOG.md", "CMakeLists.txt", "CMakePresets.json", "LICENSE",       "README", "README.md",  "docs",
    "models",       "output",         "scenarios",         "script",        "tests",  "thermal",    "twin",
};

struct Include {
  std::string file;    ///< relative to the root
  std::string header;  ///< as written
};

std::vector<Include> includes_below(fs::path const& root, std::string const& folder) {
  static std::regex const pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> found;
  if (!fs::exists(root / folder)) return found;
  for (auto const& entry : fs::recursive_directory_iterator(root / folder)) {
    auto const extension = entry.path().extension();
    if (extension != ".h" && extension != ".cc") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);)
      if (std::regex_search(line, match, pattern))
        found.push_back({fs::relative(entry.path(), root).generic_string(), match[1]});
  }
  return found;
}

Violations upward_includes(fs::path const& root) {
  Violations found;
  for (auto const& [folder, allowed] : layers)
    for (auto const& [file, header] : includes_below(root, folder)) {
      std::string const target = header.substr(0, header.find('/'));
      bool const ours = layers.contains(target) || target == "tests" || header.starts_with("..");
      if (ours && target != folder && !allowed.contains(target))
        found.push_back(fmt::format("{} includes {}: {} may not know {}", file, header, folder, target));
    }
  return found;
}

Violations leaking_seams(fs::path const& root) {
  Violations found;
  for (auto const& [folder, allowed] : layers)
    for (auto const& [file, header] : includes_below(root, folder))
      for (auto const& seam : seams)
        if (std::regex_match(header, seam.header) && !std::regex_match(file, seam.place))
          found.push_back(fmt::format("{} includes {}: outside the seam of {}", file, header, seam.library));
  return found;
}

/// Lines `/name/` and `/*.extension` of .gitignore: what running the program leaves in the root.
bool is_ignored(fs::path const& root, fs::path const& entry) {
  std::ifstream file(root / ".gitignore");
  std::string const directory = "/" + entry.filename().string() + "/";
  std::string const extension = "/*" + entry.extension().string();
  for (std::string line; std::getline(file, line);)
    if (line == directory || line == extension) return true;
  return false;
}

Violations unexpected_in_root(fs::path const& root) {
  Violations found;
  for (auto const& entry : fs::directory_iterator(root)) {
    std::string const name = entry.path().filename().string();
    if (!root_entries.contains(name) && !is_ignored(root, entry.path())) found.push_back(name);
  }
  return found;
}

TEST(Layers, PointDownwardsOnly) { EXPECT_THAT(upward_includes(THERMOTWIN_SOURCE_DIR), IsEmpty()); }
TEST(Layers, HideEachLibraryBehindOneSeam) { EXPECT_THAT(leaking_seams(THERMOTWIN_SOURCE_DIR), IsEmpty()); }
TEST(Layers, LeaveTheRootTidy) { EXPECT_THAT(unexpected_in_root(THERMOTWIN_SOURCE_DIR), IsEmpty()); }

/// A tree of one file, to see that each check can fail.
class PlantedTree : public testing::Test {
 protected:
  PlantedTree() : root_(fs::path(testing::TempDir()) / fmt::format("layers_{}", test_name())) {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  ~PlantedTree() override { fs::remove_all(root_); }

  void plant(std::string const& file, std::string const& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text << '\n';
  }

  fs::path root_;

 private:
  static std::string test_name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }
};

TEST_F(PlantedTree, UpwardIncludeIsFound) {
  plant("thermal/films/tank.h", "  #  include \"scenarios/spectrum.h\"");
  EXPECT_THAT(upward_includes(root_), testing::ElementsAre(HasSubstr("thermal/films/tank.h includes scenarios")));
}

TEST_F(PlantedTree, SiblingIncludeIsFound) {
  plant("models/ridge.cc", "#include \"thermal/network.h\"");
  EXPECT_THAT(upward_includes(root_), testing::ElementsAre(HasSubstr("models may not know thermal")));
}

TEST_F(PlantedTree, DownwardIncludeIsAllowed) {
  plant("twin/machine.cc", "#include \"thermal/network.h\"\n#include \"twin/machine.h\"\n#include <vector>");
  EXPECT_THAT(upward_includes(root_), IsEmpty());
}

TEST_F(PlantedTree, EveryLibraryOutsideItsSeamIsFound) {
  plant(
      "twin/campaign.cc",
      "#include <cvodes/cvodes.h>\n#include <klu.h>\n#include <libsvm/svm.h>\n#include <hdf5.h>\n#include <vtkNew.h>\n"
      "#include <toml++/toml.h>\n#include <CLI/CLI.hpp>");
  EXPECT_THAT(leaking_seams(root_), testing::SizeIs(7));
}

TEST_F(PlantedTree, LibraryInItsSeamIsAllowed) {
  plant("thermal/sundials.cc", "#include <cvodes/cvodes.h>\n#include \"thermal/sundials.h\"");
  plant("thermal/linear_factors.cc", "#include <klu.h>");
  plant("output/hdf5_file.cc", "#include <hdf5.h>");
  plant("twin/file/toml_reader.cc", "#include <toml++/toml.h>");
  EXPECT_THAT(leaking_seams(root_), IsEmpty());
}

TEST_F(PlantedTree, StrangerInTheRootIsFound) {
  plant("common/strings.h", "");
  plant("build/thermotwin", "");
  plant("run.h5", "");
  plant(".gitignore", "/build/\n/*.h5");
  EXPECT_THAT(unexpected_in_root(root_), testing::ElementsAre("common"));
}

}  // namespace
}  // namespace thermotwin
