#include "twin/compensation/saved_model.h"

#include <algorithm>

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double spacing = 0.05;  ///< of what is remembered, in sample periods

}  // namespace

SavedModel::SavedModel(models::ErrorModel model, std::vector<InputRange> ranges)
    : model_(std::move(model)), ranges_(std::move(ranges)) {
  for (auto const& name : model_.inputs) inputs_.push_back({name, "degC"});
  if (auto const* linear = std::get_if<models::LinearForm>(&model_.form)) longest_lag_ = linear->lags.back();
}

void SavedModel::remember(double time, VectorXd const& rise) {
  if (longest_lag_ == 0) return;
  double const period = model_.sample_period;
  if (past_.empty() || time - past_.back().time >= spacing * period) past_.push_back({time, rise});
  while (past_.size() > 1 && past_[1].time <= time - longest_lag_ * period) past_.pop_front();
}

VectorXd SavedModel::rise_at(double time) const {
  auto const after =
      std::upper_bound(past_.begin(), past_.end(), time, [](double t, Past const& past) { return t < past.time; });
  return after == past_.begin() ? VectorXd::Zero(zero_.size()) : std::prev(after)->rise;
}

std::map<std::string, std::string> SavedModel::extrapolated() const {
  std::map<std::string, std::string> result;
  for (std::size_t j = 0; j < ranges_.size() && change_.size() > 0; ++j)
    if (double const change = change_[Index(j)]; ranges_[j].left_by(change))
      result[model_.inputs[j]] = range_left_text(model_.inputs[j], change, ranges_[j]);
  return result;
}

double SavedModel::error(double time, std::span<double const> values) {
  VectorXd const now = VectorXd::Map(values.data(), Index(values.size()));
  if (zero_.size() == 0) zero_ = now;
  change_ = now - zero_;
  VectorXd const& rise = change_;
  remember(time, rise);
  Index const rows = longest_lag_ + 1;
  models::Batch batch{
      "live", VectorXd(rows), model_.inputs, model_.inputs, Eigen::MatrixXd(rows, zero_.size()), VectorXd::Zero(rows)};
  for (Index r = 0; r < rows; ++r) {
    batch.time[r] = double(r) * std::max(model_.sample_period, 1e-3);
    auto const ago = double(longest_lag_ - r);
    batch.temperature_rise.row(r) = ago > 0 ? rise_at(time - ago * model_.sample_period) : rise;
  }
  return model_.predict(batch)[rows - 1];
}

}  // namespace thermotwin::twin
