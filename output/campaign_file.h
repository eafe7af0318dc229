#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace thermotwin::output {

/// Numbers or names along a dimension that all runs share.
struct CampaignAxis {
  std::string name, unit, long_name;
  std::variant<Eigen::VectorXd, std::vector<std::string>> values;

  [[nodiscard]] std::size_t size() const;
};

/// One quantity of every run: runs × the extents of its axes, the last running fastest.
struct CampaignVariable {
  enum class Kind { real32, real64, whole } kind = Kind::real32;
  std::string name;  ///< with its group: "readings", "parameters/bearing.front.grease_factor"
  std::string unit, long_name;
  std::vector<std::string> axes;  ///< after the run
};

/// What every part of a campaign holds, and the whole.
struct CampaignLayout {
  std::string title;
  std::vector<CampaignAxis> axes;
  std::vector<CampaignVariable> variables;
  std::map<std::string, std::string> provenance;

  [[nodiscard]] CampaignAxis const& axis(std::string const& name) const;
  /// Numbers per run.
  [[nodiscard]] std::size_t size(CampaignVariable const& variable) const;
};

using CampaignValues = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int64_t>>;

/// Runs that follow one another, with all their numbers.
struct CampaignPart {
  std::int64_t first = 0, count = 0;
  std::vector<CampaignValues> values;            ///< per variable, run by run
  std::map<std::int64_t, std::string> failures;  ///< run, and why it failed
};

/// A part as an HDF5 file: `/run` (numbers of the runs) and the layout's axes as dimension scales, the variables over
/// them, `/failures/run` and `/failures/reason`. The same part gives the same bytes.
void write_part(CampaignLayout const& layout, CampaignPart const& part, std::filesystem::path const& path);

/// Runs that failed, and why; thermal::InputError when the file is no part.
[[nodiscard]] std::map<std::int64_t, std::string> read_failures(std::filesystem::path const& part);

/// thermal::InputError unless the file is a part with these runs and all variables of the layout.
void check_part(CampaignLayout const& layout, std::int64_t first, std::int64_t count,
                std::filesystem::path const& part);

/// Some runs of a part, read back.
struct CampaignRuns {
  std::vector<std::int64_t> run;
  std::vector<CampaignAxis> axes;
  std::vector<CampaignVariable> variables;  ///< without their axes
  std::vector<Eigen::MatrixXd> values;      ///< per variable: run × its numbers, the last axis running fastest

  /// Per run; null: it is not there.
  [[nodiscard]] Eigen::MatrixXd const* find(std::string const& variable) const;
};

/// Of the runs whose number is a multiple of `every`, the variables that stand in a group of `groups` or are one:
/// "parameters", "readings". Nothing else is read. thermal::InputError when the file is no part.
[[nodiscard]] CampaignRuns read_runs(std::filesystem::path const& part, std::vector<std::string> const& groups,
                                     std::int64_t every = 1);

/// A file of a part, relative to the index, and the runs in it.
struct CampaignPartFile {
  std::string file;
  std::int64_t first = 0, count = 0;
};

/// One file in which all parts look like one data set: every variable is an HDF5 virtual data set over the parts, which
/// stay where they are. `/provenance` holds the texts.
void write_index(CampaignLayout const& layout, std::vector<CampaignPartFile> const& parts,
                 std::filesystem::path const& path);

}  // namespace thermotwin::output
