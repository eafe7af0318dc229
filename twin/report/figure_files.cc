#include "twin/report/figure_files.h"

#include <algorithm>
#include <fmt/format.h>

#include "thermal/error.h"
#include "twin/diagnosis/run_files.h"

namespace thermotwin::twin {
namespace {

std::string list_of(std::vector<FigurePanel> const& panels) {
  std::string text;
  for (auto const& [name, figure] : panels) {
    text += fmt::format("{:<34}", name);
    if (!figure.rows.empty()) text += fmt::format(" {} rows", figure.rows.size());
    for (auto const& line : figure.lines)
      if (!line.name.empty()) text += " " + line.name + (&line == &figure.lines.back() ? "" : ",");
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

void keep(output::Figure& figure, std::vector<std::string> const& names) {
  for (auto const& name : names)
    if (std::none_of(figure.lines.begin(), figure.lines.end(),
                     [&](auto const& line) { return is_of(line.name, name); }))
      throw thermal::InputError(fmt::format("the panel has no curve '{}'", name));
  std::erase_if(figure.lines, [&](auto const& line) {
    return std::none_of(names.begin(), names.end(), [&](auto const& name) { return is_of(line.name, name); });
  });
}

}  // namespace

std::string write_figure_files(FigureFiles const& files) {
  auto const panels = figure_panels(files.data);
  if (files.output.empty()) return list_of(panels);
  refuse_to_overwrite(files.output, {}, files.data);
  auto figure = panel_of(panels, files.panel).figure;
  if (!files.only.empty()) keep(figure, files.only);
  figure.width = files.width;
  figure.height = files.height;
  static_cast<void>(output::write_figure(figure, files.output));
  return fmt::format("{}: {}, {:g} mm by {:g} mm\n", files.output.string(), files.panel, files.width, files.height);
}

}  // namespace thermotwin::twin
