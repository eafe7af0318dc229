#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"
#include "twin/machine.h"
#include "twin/placement/ensemble.h"
#include "twin/placement/snapshot_moments.h"

namespace thermotwin {
namespace {

/// What a map shows of each lump, which has one node, or of the first cell of a body.
std::map<std::string, double> shown(std::filesystem::path const& path, char const* name) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  auto& data = *reader->GetOutput()->GetCellData();
  auto* const bodies = vtkStringArray::SafeDownCast(data.GetAbstractArray("body_name"));
  std::map<std::string, double> values;
  for (vtkIdType i = 0; i < bodies->GetNumberOfValues(); ++i)
    values.emplace(bodies->GetValue(i), data.GetArray(name)->GetTuple1(i));
  return values;
}

/// The map that `thermotwin place --fields` writes says of every lump what the search, from the readings of a sensor
/// there, takes off the error: alone, and beside the recommended set. Where no sensor may sit it says nothing.
TEST(PlacementMap, IsWhatTheSearchSaysOfTheSites) {
  tests::TemporaryDirectory const directory;
  auto const sites_file = directory.path() / "sites.toml", map = directory.path() / "map";
  std::ofstream(sites_file) << "forbidden = [\"motor\"]\n";
  auto const json = nlohmann::json::parse(
      tests::answer(fmt::format("{} place v450 -k 3 --members 6 --unseen 1 --json --candidates {} --fields {}",
                                THERMOTWIN_PROGRAM, sites_file.string(), map.string())));

  std::vector<twin::CandidateSite> sites;
  for (auto const& sensor : json["recommended"]["sensors"])
    sites.push_back({sensor["name"], sensor["at"].get<std::vector<std::string>>()});
  std::vector<std::string> const lumps = {"head_front", "head_rear",  "column_front", "column_rear",
                                          "bed",        "front_ring", "rear_ring"};
  for (auto const& lump : lumps) sites.push_back({lump, {lump}});
  twin::EnsembleOptions options;
  options.members = 6;
  auto const ensemble = draw_ensemble(twin::read_toml(twin::machine_file("v450")), sites, options);
  auto const problem = twin::SnapshotMoments(ensemble, 0.1).problem(Eigen::Index(sites.size()));
  std::vector<Eigen::Index> const recommended = {0, 1, 2};
  auto const taken_off = [&](std::vector<Eigen::Index> set, Eigen::Index site) {
    double const before = models::remaining_variance(problem, set);
    set.push_back(site);
    return std::sqrt(before) - std::sqrt(models::remaining_variance(problem, set));
  };

  auto const alone = shown(map / "placement.vtu", "error_removed_alone_um"),
             beside = shown(map / "placement.vtu", "error_removed_beside_recommended_um");
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    auto const site = Eigen::Index(3 + i);
    double const expected = taken_off({}, site);
    EXPECT_GT(expected, 0.1) << lumps[i];
    EXPECT_NEAR(alone.at(lumps[i]), expected, 1e-5 * expected) << lumps[i];
    EXPECT_NEAR(beside.at(lumps[i]), taken_off(recommended, site), 1e-4) << lumps[i];
  }
  for (auto const* barred : {"motor", "rotor", "shaft", "test_bar"}) {
    EXPECT_TRUE(std::isnan(alone.at(barred))) << barred;
    EXPECT_TRUE(std::isnan(beside.at(barred))) << barred;
  }
}

}  // namespace
}  // namespace thermotwin
