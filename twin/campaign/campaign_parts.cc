#include "twin/campaign/campaign_parts.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "output/atomic_file.h"
#include "output/campaign_file.h"
#include "thermal/error.h"

namespace thermotwin::twin {

namespace fs = std::filesystem;

struct CampaignParts::Part {
  Part(fs::path const& journal, CampaignForm const& form, std::int64_t number, std::int64_t first, std::int64_t size)
      : number(number),
        form(form),
        journal(journal),
        results(form.part(first, size)),
        is_there(std::size_t(size)),
        missing(size) {
    for (auto const& record : this->journal.take_records()) keep(CampaignResult::from_bytes(record));
  }

  void keep(CampaignResult const& result) {
    form.put(result, results);
    auto&& there = is_there[std::size_t(result.number - results.first)];
    if (!there) --missing;
    there = true;
  }

  std::int64_t number;
  CampaignForm const& form;
  output::Journal journal;
  output::CampaignPart results;
  std::vector<bool> is_there;
  std::int64_t missing;
  std::size_t given = 0;  ///< results up to here are there or in work
};

fs::path part_file(std::int64_t part) { return fs::path("parts") / fmt::format("{:06}.h5", part); }

CampaignParts::CampaignParts(Campaign const& campaign, CampaignForm const& form, fs::path folder, Share share)
    : campaign_(campaign), form_(form), folder_(std::move(folder)), share_(share), next_part_(share.index) {
  for (std::int64_t part = share.index; part < campaign.parts(); part += share.count) runs_ += size(part);
}

CampaignParts::~CampaignParts() = default;

std::int64_t CampaignParts::size(std::int64_t part) const {
  return std::min(campaign_.runs_per_part(), campaign_.runs() - first_run(part));
}

std::int64_t CampaignParts::done() const {
  std::lock_guard const lock(mutex_);
  return done_;
}

/// A file is written whole or not at all: what is there and is no whole part is somebody else's, or was damaged.
/// InputError.
void CampaignParts::check_file(std::int64_t part) {
  std::lock_guard const lock(writing_);
  try {
    output::check_part(form_.layout(), first_run(part), size(part), folder_ / part_file(part));
  } catch (thermal::InputError const& error) {
    throw thermal::InputError(fmt::format("{}; delete the file, and its runs are made again", error.what()));
  }
}

/// False when there is no further part. A part whose file is there is done; one whose journal is whole only needs its
/// file.
bool CampaignParts::open_next() {
  current_ = nullptr;
  for (; next_part_ < campaign_.parts(); next_part_ += share_.count) {
    auto const file = folder_ / part_file(next_part_);
    auto const journal = fs::path(file).replace_extension(".journal");
    if (fs::exists(file)) {
      check_file(next_part_);
      fs::remove(journal);
      done_ += size(next_part_);
      continue;
    }
    auto part = std::make_unique<Part>(journal, form_, next_part_, first_run(next_part_), size(next_part_));
    done_ += part->results.count - part->missing;
    if (part->missing == 0) {  // whoever made it was killed before its file was there
      output::remove_leftovers(file);
      close(*part);
      continue;
    }
    current_ = (open_[next_part_] = std::move(part)).get();
    next_part_ += share_.count;
    return true;
  }
  return false;
}

std::optional<std::int64_t> CampaignParts::next() {
  std::lock_guard const lock(mutex_);
  for (;;) {
    if (current_)
      for (auto& given = current_->given; given < current_->is_there.size();)
        if (auto const at = given++; !current_->is_there[at]) return current_->results.first + std::int64_t(at);
    if (!open_next()) return std::nullopt;
  }
}

void CampaignParts::put(CampaignResult const& result) {
  std::unique_ptr<Part> whole;
  {
    std::string const record = result.to_bytes();
    std::lock_guard const lock(mutex_);
    auto const place = open_.find(result.number / campaign_.runs_per_part());
    auto& part = *place->second;
    part.journal.append(record);
    part.keep(result);
    ++done_;
    if (part.missing > 0) return;
    if (current_ == &part) current_ = nullptr;
    whole = std::move(place->second);
    open_.erase(place);
  }
  close(*whole);
}

void CampaignParts::close(Part& part) {
  std::lock_guard const lock(writing_);
  output::write_part(form_.layout(), part.results, folder_ / part_file(part.number));
  part.journal.remove();
}

}  // namespace thermotwin::twin
