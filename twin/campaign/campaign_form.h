#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "output/campaign_file.h"
#include "output/dataset.h"
#include "twin/campaign/campaign.h"
#include "twin/machine.h"
#include "twin/reduced_twin.h"

namespace thermotwin::twin {

/// What stays of one run.
struct CampaignResult {
  std::int64_t number = 0, rows = 0;
  std::string failure;         ///< why it failed; empty: it did not
  std::vector<float> numbers;  ///< what is kept, in the order of the form; empty when it failed

  [[nodiscard]] std::string to_bytes() const;
  static CampaignResult from_bytes(std::string const& bytes);
};

/// How a campaign's results are laid out, the same for all runs. Per run: `experiment` (its number in the list),
/// `seed`, `rows` (readings that it has; a shorter experiment ends in NaN), `failed`, `parameters/<path>`; then what is
/// kept, over time and channel.
class CampaignForm {
 public:
  /// From the campaign's nominal machine.
  CampaignForm(Campaign const& campaign, Machine const& machine);

  [[nodiscard]] output::CampaignLayout const& layout() const { return layout_; }

  /// What is kept of a data set. InputError when its channels are not those of the nominal machine.
  [[nodiscard]] std::vector<float> kept(output::Dataset const& dataset) const;
  /// The same of a reduced run, and its bounds.
  [[nodiscard]] std::vector<float> kept(ReducedResult const& result) const;
  /// A part that lacks all its results.
  [[nodiscard]] output::CampaignPart part(std::int64_t first, std::int64_t count) const;
  void put(CampaignResult const& result, output::CampaignPart& part) const;

 private:
  void add_axes(Machine const& machine);
  void add_variables();
  void keep(std::string const& name, std::string const& unit, std::string const& long_name,
            std::vector<std::string> const& axes);

  Campaign const& campaign_;
  output::CampaignLayout layout_;
  std::size_t rows_ = 0, first_kept_ = 0, numbers_ = 0;
  std::vector<std::string> readings_, displacements_, inputs_;
};

}  // namespace thermotwin::twin
