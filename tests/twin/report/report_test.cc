#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "output/dataset_file.h"
#include "output/field_mesh.h"
#include "tests/output/page_reader.h"
#include "tests/output/temporary_directory.h"
#include "tests/twin/report/in_other_units.h"
#include "thermal/error.h"
#include "thermal/growth_field.h"
#include "twin/experiment_file.h"
#include "twin/file/text_file.h"
#include "twin/report/machine_section.h"
#include "twin/report/report_files.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using testing::Test;
using tests::PageReader;
using tests::TemporaryDirectory;

/// An hour of v450 with all its nodes, as `run --nodes` leaves it.
output::Dataset short_run() {
  auto document = read_toml(experiment_file("golden_b_4000"));
  set_parameter(document, "duration", "1 h");
  auto const experiment = read_experiment(document, experiment_file("golden_b_4000"));
  RunOptions options;
  options.node_temperatures = true;
  options.provenance = {{"machine.file", text_of_file(machine_file("v450"))},
                        {"settings", "lump.motor.mass=\"20 kg\""}};
  return run(Machine::read(machine_file("v450")), experiment, options).dataset;
}

class Report : public Test {
 protected:
  static void SetUpTestSuite() { dataset = short_run(); }

  PageReader report(std::vector<std::filesystem::path> const& data) {
    (void)write_report({data, "", folder / "report.html"});
    return PageReader(tests::contents(folder / "report.html"));
  }

  std::filesystem::path written(std::string const& name, output::Dataset const& data = dataset) {
    output::write(data, folder / name);
    return folder / name;
  }

  std::filesystem::path text(std::string const& name, std::string const& content) {
    tests::put(folder / name, content);
    return folder / name;
  }

  inline static output::Dataset dataset;
  TemporaryDirectory folder;
};

nlohmann::json const& section(PageReader const& page, std::string const& kind) {
  for (auto const& entry : page.document["sections"])
    if (entry["kind"] == kind) return entry;
  throw std::runtime_error("no section of kind " + kind);
}

TEST_F(Report, CarriesEveryCourseOfARun) {
  auto const page = report({written("run.h5")});
  auto const& set = section(page, "runs")["sets"][0];
  EXPECT_TRUE(set["simulated"]);
  ASSERT_EQ(set["readings"].size(), dataset.readings.size());
  for (std::size_t c = 0; c < dataset.readings.size(); ++c) {
    auto const values = page.numbers<float>(set["readings"][c]["values"]);
    ASSERT_EQ(Eigen::Index(values.size()), dataset.time_s.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_FLOAT_EQ(values[i], float(dataset.readings[c].values[Eigen::Index(i)]));
  }
}

/// Another day at the same speed has a residual; a day at another speed has none.
TEST_F(Report, ComparesOnlyWhatWentThroughTheSame) {
  auto slightly = dataset, otherwise = dataset;
  for (auto& input : slightly.inputs)
    if (input.name == "spindle.speed") input.values *= 1.05;
  for (auto& input : otherwise.inputs)
    if (input.name == "spindle.speed") input.values *= 1.5;
  auto const page = report({written("run.h5"), written("tuesday.h5", slightly), written("faster.h5", otherwise)});
  auto const& runs = section(page, "runs");
  EXPECT_TRUE(runs["sets"][1]["compared"]);
  EXPECT_FALSE(runs["sets"][2]["compared"]);
  EXPECT_THAT(runs["remarks"].dump(), testing::HasSubstr("faster.h5 was driven otherwise than run.h5"));
}

/// The page subtracts what it is given: a measurement must come in the units of a run.
TEST_F(Report, HasTheSameInOtherUnitsInThoseOfARun) {
  auto const page = report({tests::put_in_other_units(dataset, folder), written("run.h5")});
  auto const &mine = section(page, "runs")["sets"][0], &theirs = section(page, "runs")["sets"][1];
  for (char const* group : {"readings", "displacements"}) {
    ASSERT_EQ(mine[group].size(), theirs[group].size());
    for (std::size_t c = 0; c < mine[group].size(); ++c) {
      EXPECT_EQ(mine[group][c]["unit"], theirs[group][c]["unit"]);
      EXPECT_EQ(page.numbers<float>(mine[group][c]["values"]), page.numbers<float>(theirs[group][c]["values"]));
    }
  }
  EXPECT_TRUE(theirs["compared"]);
  EXPECT_EQ(mine["readings"][0]["longest_gap"], 6000.0);
  EXPECT_FALSE(theirs["readings"][0].contains("longest_gap"));
}

/// By the name in the measurement file: a file beside it, or else a machine that comes with the program.
TEST_F(Report, DrawsTheMachineThatAMeasurementNames) {
  auto const given = [&](std::string const& machine) {
    return report(
        {tests::put_in_other_units(dataset, folder, "title = \"Montag, Aufwärmen\"\nmachine = \"" + machine + "\"\n")});
  };
  auto const shipped = given("v450");
  EXPECT_EQ(shipped.document["title"], "Montag, Aufwärmen");
  EXPECT_TRUE(section(shipped, "runs").contains("machine"));
  auto const unknown = given("mine");
  EXPECT_FALSE(section(unknown, "runs").contains("machine"));
  EXPECT_THAT(section(unknown, "runs")["remarks"].dump(),
              testing::HasSubstr("other.toml says that it was 'mine', but there is no mine.toml beside it, and none "
                                 "such is shipped; name its file with --machine"));
  auto mine = text_of_file(machine_file("v450"));
  auto const title = mine.find("title = \"") + 9;
  mine.replace(title, mine.find('"', title) - title, "a copy that still calls itself v450");
  text("mine.toml", mine);
  for (std::string const file : {"mine", "mine.toml"})
    EXPECT_EQ(section(given(file), "runs")["machine"]["title"], "a copy that still calls itself v450") << file;
}

TEST_F(Report, TellsAnInputThatNeverChangesAsOneNumber) {
  auto const page = report({written("run.h5")});
  for (auto const& input : section(page, "runs")["sets"][0]["inputs"])
    if (input["name"] == "ambient.gradient") {
      EXPECT_EQ(input["constant"], 0.0);
      return;
    }
  FAIL() << "no ambient.gradient";
}

/// What the browser computes must be what the mesh shows, to the error that the page states and the quantisation.
TEST_F(Report, RebuildsTemperatureAndDisplacementOfTheSurface) {
  auto const page = report({written("run.h5")});
  auto const& machine = section(page, "runs")["machine"];
  auto const& field = machine["field"];
  auto const points = page.numbers<float>(machine["points"]);
  std::size_t const n = points.size() / 3, modes = field["temperature"]["shape"][0];
  auto const start = page.numbers<float>(field["start"]), courses = page.numbers<float>(field["courses"]);
  auto const temperature = page.numbers<std::int16_t>(field["temperature"]);
  auto const displacement = page.numbers<std::int16_t>(field["displacement"]);
  std::size_t const row = std::size_t(dataset.time_s.size()) - 1;

  Machine const built = Machine::read(machine_file("v450"));
  output::FieldMesh const mesh(built.geometry);
  Eigen::VectorXd const nodes = dataset.node_temperatures->row(Eigen::Index(row)).cast<double>();
  Eigen::VectorXd const rise = nodes - dataset.node_temperatures->row(0).transpose().cast<double>();
  Eigen::VectorXd const shown = mesh.mean_at_points(nodes.head(mesh.n_nodes()));
  Eigen::Matrix3Xd const grown =
      mesh.continued_to_points(thermal::growth_field(built.growing, {rise.data(), std::size_t(rise.size())}));
  double const error = field["largest_error"].get<double>() + 0.005, span = grown.cwiseAbs().maxCoeff();
  for (std::size_t p = 0; p < n; ++p) {
    double t = start[p];
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < modes; ++k) {
      double const c = courses[row * modes + k];
      t += c * field["temperature"]["scales"][k].get<double>() * temperature[k * n + p];
      for (std::size_t i = 0; i < 3; ++i)
        u[Eigen::Index(i)] +=
            c * field["displacement"]["scales"][k].get<double>() * displacement[k * 3 * n + 3 * p + i];
    }
    Eigen::Vector3d const place(points[3 * p], points[3 * p + 1], points[3 * p + 2]);
    Eigen::Index at = 0;
    double nearest = INFINITY;  // bodies touch: of the mesh's points here, the one that fits
    for (Eigen::Index q = 0; q < mesh.points().cols(); ++q)
      if ((mesh.points().col(q) - place).norm() < 1e-6 && std::abs(shown[q] - t) < nearest) {
        nearest = std::abs(shown[q] - t);
        at = q;
      }
    EXPECT_LT(nearest, error);
    EXPECT_LT((grown.col(at) - u).norm(), 0.02 * span);
  }
}

TEST_F(Report, BuildsTheMachineWithItsSettings) {
  auto const machine = machine_of({folder / "run.h5", dataset, true});
  ASSERT_TRUE(machine);
  EXPECT_EQ(machine->name, "v450");
  auto unknown = dataset;
  unknown.provenance["settings"] = "lump.mtor.mass=\"20 kg\"";
  EXPECT_THROW((void)machine_of({folder / "run.h5", unknown, true}), thermal::InputError);
}

TEST_F(Report, DrawsNoFieldWithoutNodesAndSaysSo) {
  auto bare = dataset;
  bare.node_temperatures.reset();
  bare.node_names.clear();
  auto const page = report({written("bare.h5", bare)});
  EXPECT_FALSE(section(page, "runs")["machine"].contains("field"));
  EXPECT_NE(section(page, "runs")["remarks"].dump().find("--nodes"), std::string::npos);
}

TEST_F(Report, DrawsNoMachineWhenNobodySaysWhich) {
  auto foreign = dataset;
  foreign.provenance.clear();
  auto const page = report({written("foreign.h5", foreign)});
  EXPECT_FALSE(section(page, "runs").contains("machine"));
  EXPECT_NE(section(page, "runs")["remarks"].dump().find("--machine"), std::string::npos);
}

constexpr char const* either = R"({"verdict": "either", "effects": [
  {"group": 0, "effect": "bearing_shift", "site": "E_Z", "body": "E_Z", "parameter": "weight", "amplitude": -0.2262091,
   "low": -0.2987953, "high": -0.1536229, "unit": "1", "keys": {}, "weight": 0.98, "strength": 55.0},
  {"group": 0, "effect": "centrifugal_growth", "site": "E_Z", "body": "E_Z", "parameter": "growth",
   "amplitude": -8.921e-7, "low": -1.189e-6, "high": -5.949e-7, "unit": "m", "keys": {}, "weight": 0.02,
   "strength": 48.0}],
  "where": [], "gap": {"before": 2.0, "after": 1.0}, "gaps": {"fitted": [], "held_out": []},
  "unaccounted_heat": [], "estimates": [], "remarks": []})";

TEST_F(Report, NamesWhatADiagnosisFound) {
  auto const page = report({text("found.json", either)});
  auto const& found = section(page, "diagnosis");
  EXPECT_EQ(found["sentence"], "The machine file lacks bearing shift at E_Z, or centrifugal growth at E_Z.");
  EXPECT_EQ(found["effects"][0]["meaning"], effect("bearing_shift").meaning);
  EXPECT_EQ(found["effects"][0]["text"], "-0.226 (-0.299 to -0.154)");
  EXPECT_EQ(found["effects"][1]["text"], "-0.892 um (-1.19 um to -0.595 um)");
}

/// A map of 1, 2, 3, … over the machine's nodes, and twice that beside the recommended sensors.
std::string placement_of(std::string const& machine, Eigen::Index nodes) {
  std::vector<double> alone, beside;
  for (Eigen::Index i = 1; i <= nodes; ++i) {
    alone.push_back(double(i));
    beside.push_back(2.0 * double(i));
  }
  nlohmann::json json = {
      {"machine", machine}, {"candidates", 200}, {"map", {{"alone_um", alone}, {"beside_um", beside}}}};
  json["recommended"]["sensors"] = {{{"name", "air"}, {"at", {"ambient"}}, {"position_m", {0, 0, 0}}},
                                    {{"name", "motor"}, {"at", {"motor"}}, {"position_m", {0, 0.1, 0.2}}}};
  return json.dump();
}

TEST_F(Report, PaintsWhereSensorsTellMost) {
  auto const built = Machine::read(machine_file("v450"));
  auto const page = report({text("placement.json", placement_of("v450", built.network().nodes()))});
  auto const& found = section(page, "placement");
  EXPECT_FALSE(found.contains("map"));
  auto const& shape = found["shape"];
  ASSERT_EQ(shape["sensors"].size(), 1U);
  EXPECT_EQ(shape["sensors"][0]["name"], "2");
  auto const start = page.numbers<float>(shape["field"]["start"]);
  auto const change = page.numbers<std::int16_t>(shape["field"]["temperature"]);
  double const scale = shape["field"]["temperature"]["scales"][0];
  ASSERT_EQ(start.size(), change.size());
  for (std::size_t p = 0; p < start.size(); ++p)  // beside = 2 alone, so that the change is the start again
    EXPECT_NEAR(scale * change[p], start[p], 0.01);
}

/// What the answer says of its sets, and nothing off the error where no sensor may sit.
TEST_F(Report, KeepsTheRemarksOfAPlacement) {
  auto const nodes = Machine::read(machine_file("v450")).network().nodes();
  auto placement = nlohmann::json::parse(placement_of("v450", nodes));
  placement["remarks"] = {"2 would do"};
  for (auto* map : {&placement["map"]["alone_um"], &placement["map"]["beside_um"]})
    for (auto& value : *map) value = nullptr;
  auto const page = report({text("placement.json", placement.dump())});
  auto const& found = section(page, "placement");
  EXPECT_EQ(found["remarks"], nlohmann::json::array({"2 would do"}));
  EXPECT_THAT(page.numbers<float>(found["shape"]["field"]["start"]), testing::Each(0.0F));
}

TEST_F(Report, SaysWhyNoMapIsDrawn) {
  auto const remark = [&](std::string const& placement) {
    return section(report({text("placement.json", placement)}), "placement")["remarks"].dump();
  };
  EXPECT_NE(remark(placement_of("nobody", 3)).find("--machine"), std::string::npos);
  EXPECT_NE(remark(placement_of("v450", 3)).find("3 numbers for the"), std::string::npos);
  EXPECT_NE(remark(R"({"recommended": {"sensors": []}, "candidates": 4, "machine": "v450"})").find("--report"),
            std::string::npos);
}

TEST_F(Report, ShowsAStudyWithoutTheValuesOfEachRepetition) {
  auto const page = report({text("study.json", R"({"title": "two", "worlds": [], "claims": [], "selections": [],
    "combinations": [{"figures": {"cross.rmse": {"mean": 2.5, "half_width_95": 0.5, "values": [2, 3]}}}]})")});
  auto const& figure = section(page, "study")["combinations"][0]["figures"]["cross.rmse"];
  EXPECT_EQ(figure["mean"], 2.5);
  EXPECT_FALSE(figure.contains("values"));
}

TEST_F(Report, TakesNoOtherJson) {
  EXPECT_THROW(report({text("other.json", "{\"verdict\": 3}")}), thermal::InputError);
  EXPECT_THROW(report({text("broken.json", "{")}), thermal::InputError);
  EXPECT_THROW(report({text("partial.json", R"({"steps": [], "title": 3})")}), thermal::InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
}

TEST_F(Report, SaysWhichAnswerOfAFolderItTakes) {
  auto const out = folder / "out";
  std::filesystem::create_directory(out);
  auto const refused = [&] {
    try {
      (void)report({out});
    } catch (thermal::InputError const& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  EXPECT_EQ(refused(), "'" + out.string() + "' is a folder; data sets and answers (.json) are due; `thermotwin view " +
                           out.string() + "` shows what comes into it");
  text("out/study.json", "{}");
  EXPECT_EQ(refused(),
            "'" + out.string() + "' is the folder of a study; its answer is '" + (out / "study.json").string() + "'");
}

TEST_F(Report, NeverOverwritesWhatItReads) {
  auto const path = written("run.h5");
  EXPECT_THROW((void)write_report({{path}, "", path}), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
