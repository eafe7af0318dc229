#include "twin/report/figure_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/file/output_path.h"

namespace thermotwin::twin {
namespace {

using output::FigureLine;

/// A curve is called "T1", or "T1, monday" among several data sets.
std::string channel_of(FigureLine const& line) { return line.name.substr(0, line.name.find(", ")); }
std::string data_set_of(FigureLine const& line) { return line.name.substr(line.name.find(", ") + 2); }

void add_new(std::vector<std::string>& names, std::string const& name) {
  if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// Per panel what `only` takes, and where several data sets are drawn, which.
std::string list_of(std::vector<FigurePanel> const& panels) {
  std::string text;
  for (auto const& panel : panels) {
    auto const& figure = panel.figure;
    std::vector<std::string> channels, data_sets;
    for (auto const& line : figure.lines) add_new(channels, channel_of(line));
    if (!panel.runs.empty())
      for (auto const& line : figure.lines) add_new(data_sets, data_set_of(line));
    text += fmt::format("{:<34}", panel.name);
    if (!figure.rows.empty()) text += fmt::format(" {} rows", figure.rows.size());
    if (!channels.empty()) text += fmt::format(" {}", fmt::join(channels, ", "));
    if (!data_sets.empty()) text += fmt::format(" (of {})", fmt::join(data_sets, ", "));
    text += "\n";
  }
  return text;
}

FigurePanel const& panel_of(std::vector<FigurePanel> const& panels, std::string const& name) {
  std::vector<std::string> names;
  for (auto const& panel : panels) {
    if (panel.name == name) return panel;
    names.push_back(panel.name);
  }
  throw thermal::InputError(fmt::format("these data have no panel '{}'; they have {}", name, fmt::join(names, ", ")));
}

/// "T1" also picks "T1, monday".
bool is_of(std::string const& curve, std::string const& name) {
  return curve == name || curve.starts_with(name + ", ");
}

/// What `only` takes.
std::vector<std::string> curves_of(FigurePanel const& panel) {
  std::vector<std::string> curves;
  for (auto const& line : panel.figure.lines) add_new(curves, channel_of(line));
  for (auto const& line : panel.figure.lines) add_new(curves, line.name);
  return curves;
}

void keep(FigurePanel& panel, std::vector<std::string> const& names) {
  auto& lines = panel.figure.lines;
  if (lines.empty())
    throw thermal::InputError(fmt::format("--only: the panel '{}' has rows, and no curves to choose from", panel.name));
  for (auto const& name : names)
    if (std::none_of(lines.begin(), lines.end(), [&](auto const& line) { return is_of(line.name, name); }))
      throw thermal::InputError(fmt::format("the panel '{}' has no curve '{}'; {}", panel.name, name,
                                            thermal::did_you_mean(name, curves_of(panel))));
  for (std::size_t i = lines.size(); i-- > 0;) {
    auto const& line = lines[i];
    if (std::any_of(names.begin(), names.end(), [&](auto const& name) { return is_of(line.name, name); })) continue;
    lines.erase(lines.begin() + std::ptrdiff_t(i));
    if (!panel.runs.empty()) panel.runs.erase(panel.runs.begin() + std::ptrdiff_t(i));
  }
}

/// Of one channel alone, each data set has its colour beside its dashes, as on the page.
void colour_by_run(FigurePanel& panel) {
  auto& lines = panel.figure.lines;
  for (auto const& line : lines)
    if (panel.runs.empty() || channel_of(line) != channel_of(lines[0])) return;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    auto const dashes = lines[i].dashes;
    output::set_style(lines[i], panel.runs[i]);
    lines[i].dashes = dashes;
  }
}

}  // namespace

std::string write_figure_files(FigureFiles const& files) {
  auto const panels = figure_panels(files.data);
  if (panels.empty()) throw thermal::InputError("these data have no panel that could be a figure; `report` shows them");
  if (files.output.empty()) return list_of(panels);
  refuse_to_overwrite(files.output, {}, files.data);
  auto panel = panel_of(panels, files.panel);
  if (!files.only.empty()) keep(panel, files.only);
  colour_by_run(panel);
  auto& figure = panel.figure;
  figure.width = files.width;
  figure.height = files.height;
  static_cast<void>(output::write_figure(figure, files.output));
  return fmt::format("{}: {}, {:g} mm by {:g} mm\n", files.output.string(), files.panel, files.width, files.height);
}

}  // namespace thermotwin::twin
