#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "output/picture_scale.h"
#include "output/report_page.h"
#include "output/viridis.h"
#include "twin/diagnosis/estimate_text.h"
#include "twin/report/answer_section.h"
#include "twin/report/figure_files.h"
#include "twin/report/shown_run.h"

namespace thermotwin::twin {
namespace {

using output::Channel;
using output::Figure;
using output::FigureLine;
using output::Json;

using Channels = std::vector<Channel> const& (*)(output::Dataset const&);

std::string unit_text(std::string const& unit) {
  static std::map<std::string, std::string> const symbols = {{"degC", "°C"}, {"um", "µm"}, {"urad", "µrad"}};
  auto const found = symbols.find(unit);
  return found == symbols.end() ? unit : found->second;
}

std::string axis_text(std::string const& quantity, std::string const& unit) {
  return unit == "1" ? quantity : fmt::format("{} / {}", quantity, unit_text(unit));
}

std::string quantity_of(std::string const& unit) {
  static std::map<std::string, std::string> const quantities = {
      {"rpm", "Speed"},       {"mm/min", "Feed"}, {"degC", "Temperature"}, {"K", "Temperature"}, {"W", "Heat"},
      {"um", "Displacement"}, {"urad", "Tilt"},   {"mm", "Position"},      {"K/m", "Gradient"},  {"1", "Setting"},
  };
  auto const found = quantities.find(unit);
  return found == quantities.end() ? "Value" : found->second;
}

struct TimeUnit {
  std::string name;
  double seconds;
};

TimeUnit time_unit(double duration) {
  if (duration >= 2 * 3600.0) return {"h", 3600.0};
  return duration >= 180.0 ? TimeUnit{"min", 60.0} : TimeUnit{"s", 1.0};
}

std::string file_part(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_'; }, '_');
  return text;
}

/// Courses over time, in the unit that suits the longest of them.
class TimeFigure {
 public:
  TimeFigure(std::string y_label, double start, double end) : unit_(time_unit(end - start)) {
    figure_.x_label = "Time / " + unit_.name;
    figure_.y_label = std::move(y_label);
    figure_.x_range = {start / unit_.seconds, end / unit_.seconds};
  }

  FigureLine& add(std::string const& name, Eigen::VectorXd const& time_s, Eigen::VectorXd const& values) {
    figure_.lines.push_back({name, time_s / unit_.seconds, values});
    output::set_style(figure_.lines.back(), figure_.lines.size() - 1);
    return figure_.lines.back();
  }
  void add_band(Eigen::VectorXd const& time_s, Eigen::VectorXd const& low, Eigen::VectorXd const& high) {
    figure_.bands.push_back({time_s / unit_.seconds, low, high});
  }
  [[nodiscard]] Figure take() { return std::move(figure_); }

 private:
  TimeUnit unit_;
  Figure figure_;
};

bool varies(Eigen::VectorXd const& values) {
  return values.size() > 0 && !(values.array() == values[0]).all() && values.array().isFinite().any();
}

/// The first row in which anything is shown: a measurement may begin long after its run.
double start_of(ShownRun const& run) {
  auto const& data = run.data;
  for (Eigen::Index row = 0; row < data.time_s.size(); ++row)
    for (auto const* channels : {&data.inputs, &data.readings, &data.displacements})
      for (auto const& channel : *channels)
        if (std::isfinite(channel.values[row]) && varies(channel.values)) return data.time_s[row];
  return data.time_s.size() > 0 ? data.time_s[0] : 0.0;
}
double end_of(ShownRun const& run) { return run.data.time_s.size() > 0 ? run.data.time_s.tail(1)[0] : 1.0; }

std::pair<double, double> range_of(std::vector<ShownRun> const& runs) {
  std::pair range{start_of(runs[0]), end_of(runs[0])};
  for (auto const& run : runs) range = {std::min(range.first, start_of(run)), std::max(range.second, end_of(run))};
  return range;
}

/// Units in order of appearance, angles last.
std::vector<std::string> units_of(std::vector<ShownRun> const& runs, Channels channels) {
  std::vector<std::string> units;
  for (auto const& run : runs)
    for (auto const& channel : channels(run.data))
      if (std::find(units.begin(), units.end(), channel.unit) == units.end()) units.push_back(channel.unit);
  std::stable_partition(units.begin(), units.end(), [](auto const& unit) { return unit != "urad"; });
  return units;
}

/// A channel has one colour, a data set one way of dashing; the reference is solid.
class CoursesOfRuns {
 public:
  CoursesOfRuns(TimeFigure figure, bool several) : figure_(std::move(figure)), several_(several) {}

  /// `of`: what bears the channel, where there are several.
  void add(std::string const& channel, std::string const& of, std::size_t r, Samples const& samples) {
    static std::vector<std::vector<double>> const dashes = {{}, {4.0, 2.0}, {1.0, 1.5}, {6.0, 2.0, 1.0, 2.0}};
    auto const known = std::find(names_.begin(), names_.end(), channel);
    auto const i = std::size_t(known - names_.begin());
    if (known == names_.end()) names_.push_back(channel);
    auto const name = several_ ? fmt::format("{}, {}", channel, of) : channel;
    auto& line = figure_.add(name, samples.time_s, samples.values);
    output::set_style(line, i);
    if (!several_) return;
    if (i >= 7)  // dashes tell runs apart here: later channels are pale
      for (double& part : line.colour) part = 1.0 - 0.5 * (1.0 - part);
    line.dashes = dashes[r % dashes.size()];
    runs_.push_back(r);
  }
  [[nodiscard]] FigurePanel take(std::string const& name) { return {name, figure_.take(), std::move(runs_)}; }

 private:
  TimeFigure figure_;
  bool several_;
  std::vector<std::string> names_;
  std::vector<std::size_t> runs_;
};

/// Every channel of a unit.
FigurePanel courses(std::vector<ShownRun> const& runs, Channels channels, std::string const& unit,
                    std::string const& name) {
  auto const [start, end] = range_of(runs);
  CoursesOfRuns panel(TimeFigure(axis_text(quantity_of(unit), unit), start, end), runs.size() > 1);
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (auto const& channel : channels(runs[r].data))
      if (channel.unit == unit) panel.add(channel.name, runs[r].stem(), r, samples_of(runs[r], channel.values));
  return panel.take(name);
}

/// The reference less each of the others that went through the same, dashed as these are beside it.
FigurePanel residuals(std::vector<ShownRun> const& runs, Channels channels, std::string const& unit,
                      std::string const& name) {
  auto const& reference = runs[0].data;
  auto const difference = [&](std::size_t r) { return fmt::format("{} − {}", runs[0].stem(), runs[r].stem()); };
  bool const pair = runs.size() == 2;
  CoursesOfRuns panel(TimeFigure(axis_text(pair ? difference(1) : "Residual", unit == "degC" ? "K" : unit),
                                 start_of(runs[0]), end_of(runs[0])),
                      !pair);
  for (std::size_t r = 1; r < runs.size(); ++r) {
    if (!driven_alike(runs[0], runs[r])) continue;
    for (auto const& mine : channels(reference))
      for (auto const& other : channels(runs[r].data)) {
        if (mine.unit != unit || other.unit != unit || other.name != mine.name) continue;
        auto const theirs = samples_of(runs[r], other.values);
        Eigen::VectorXd const left = mine.values - output::at_times(theirs.values, theirs.time_s, reference.time_s);
        panel.add(mine.name, difference(r), r, samples_of(runs[0], left));
      }
  }
  return panel.take(name);
}

/// Forward solid, backward dashed, from dark to light with time, in the page's colours.
Figure positioning(output::Positioning const& axis) {
  constexpr double lightest = 0.86;  // of viridis, on white paper
  Figure figure;
  figure.x_label = "Position / mm";
  figure.y_label = "Error / µm";
  Eigen::Index const passes = axis.time_s.size();
  for (Eigen::Index p = 0; p < passes; ++p)
    for (bool const forward : {true, false}) {
      FigureLine line{"", axis.position_mm, (forward ? axis.forward_um : axis.backward_um).row(p).transpose()};
      if (p == 0 || p + 1 == passes)
        line.name = (forward ? "forward, " : "backward, ") + output::time_text(axis.time_s[p]);
      line.colour = output::viridis(passes > 1 ? lightest * double(p) / double(passes - 1) : 0.5);
      if (!forward) line.dashes = {3.0, 2.0};
      figure.lines.push_back(line);
    }
  return figure;
}

void add_group(std::vector<FigurePanel>& panels, std::vector<ShownRun> const& runs, std::string const& title,
               Channels channels) {
  for (auto const& unit : units_of(runs, channels)) {
    auto const name = fmt::format("{}_{}", unit == "urad" ? "tilt" : title, file_part(unit));
    panels.push_back(courses(runs, channels, unit, name));
    if (auto difference = residuals(runs, channels, unit, "residual_" + name); !difference.figure.lines.empty())
      panels.push_back(std::move(difference));
  }
}

/// What is set and stays: speeds, feeds, switches, shares. Air and positions go from one value to the next.
bool is_held(output::Channel const& input) {
  static std::set<std::string> const units = {"rpm", "mm/min", "1", "W", "kg/s"};
  return units.contains(input.unit);
}

/// Each value until the next sample, where there is one.
Samples held(Samples const& samples) {
  auto const& [time_s, values] = samples;
  Eigen::Index const steps = std::max(Eigen::Index(0), time_s.size() - 1);
  Samples drawn{Eigen::VectorXd(time_s.size() + steps), Eigen::VectorXd(time_s.size() + steps)};
  for (Eigen::Index i = 0; i < time_s.size(); ++i) {
    drawn.time_s[2 * i] = time_s[i];
    drawn.values[2 * i] = values[i];
    if (i == steps) break;
    drawn.time_s[2 * i + 1] = time_s[i + 1];
    drawn.values[2 * i + 1] = std::isnan(values[i + 1]) ? values[i + 1] : values[i];
  }
  return drawn;
}

/// Some channels of a run.
struct Picked {
  ShownRun const* run;
  std::vector<Channel const*> channels{};
};

/// Whether one shows what the other does wherever it shows anything, to a thousandth of its largest value.
bool shows(ShownRun const& run, Channel const& course, ShownRun const& other, Channel const& theirs) {
  auto const known = samples_of(run, course.values);
  Eigen::ArrayXd const mine = output::at_times(known.values, known.time_s, other.data.time_s);
  auto const due = theirs.values.array().isFinite();
  double const near = 1e-3 * due.select(theirs.values.array().abs(), 0.0).maxCoeff();
  return (!due || (theirs.values.array() - mine).abs() <= near).all();
}

bool same_courses(Picked const& some, Picked const& others) {
  auto const has = [&](Channel const* mine) {
    return std::any_of(others.channels.begin(), others.channels.end(), [&](Channel const* theirs) {
      return theirs->name == mine->name && shows(*some.run, *mine, *others.run, *theirs) &&
             shows(*others.run, *theirs, *some.run, *mine);
    });
  };
  return some.channels.size() == others.channels.size() && std::all_of(some.channels.begin(), some.channels.end(), has);
}

/// The runs with channels; the first alone where all have the same.
std::vector<Picked> distinct(std::vector<Picked> runs) {
  std::erase_if(runs, [](auto const& run) { return run.channels.empty(); });
  bool const same = std::all_of(runs.begin(), runs.end(), [&](auto const& run) { return same_courses(runs[0], run); });
  if (same && !runs.empty()) runs.erase(runs.begin() + 1, runs.end());
  return runs;
}

/// All but counters, beside which flags and shares would be a line at 0; of each run where they were given otherwise.
void add_inputs(std::vector<FigurePanel>& panels, std::vector<ShownRun> const& runs) {
  auto const [start, end] = range_of(runs);
  for (auto const& unit : units_of(
           runs, [](auto const& d) -> auto const& { return d.inputs; })) {
    std::set<std::string> names;
    for (auto const& run : runs)
      for (auto const& input : run.data.inputs)
        if (input.unit == unit && varies(input.values) && !input.name.ends_with(".revolutions"))
          names.insert(input.name);
    if (names.empty()) continue;
    std::vector<Picked> given;
    for (auto const& run : runs) {
      given.push_back({&run});
      for (auto const& input : run.data.inputs)
        if (input.unit == unit && names.contains(input.name)) given.back().channels.push_back(&input);
    }
    given = distinct(std::move(given));
    CoursesOfRuns panel(TimeFigure(axis_text(quantity_of(unit), unit), start, end), given.size() > 1);
    for (auto const& [run, inputs] : given)
      for (auto const* input : inputs) {
        auto const samples = samples_of(*run, input->values);
        panel.add(input->name, run->stem(), std::size_t(run - runs.data()), is_held(*input) ? held(samples) : samples);
      }
    panels.push_back(panel.take("input_" + file_part(unit)));
  }
}

/// A panel for each run that differs: over one another the sources of several were too many to tell apart.
void add_heat(std::vector<FigurePanel>& panels, std::vector<ShownRun> const& runs) {
  std::vector<Picked> made;
  for (auto const& run : runs) {
    made.push_back({&run});
    for (auto const& source : run.data.heat)
      if ((source.values.array() != 0.0).any()) made.back().channels.push_back(&source);
  }
  made = distinct(std::move(made));
  for (auto const& [run, sources] : made) {
    TimeFigure heat("Heat / W", start_of(*run), end_of(*run));
    for (auto const* source : sources) {
      auto const samples = samples_of(*run, source->values);
      heat.add(source->name, samples.time_s, samples.values);
    }
    panels.push_back({made.size() > 1 ? "heat_" + run->stem() : "heat", heat.take()});
  }
}

void add_runs(std::vector<FigurePanel>& panels, std::vector<ShownRun> runs) {
  auto const measured = std::find_if(runs.begin(), runs.end(), [](auto const& run) { return !run.simulated; });
  if (measured != runs.end()) std::rotate(runs.begin(), measured, measured + 1);
  add_inputs(panels, runs);
  add_group(
      panels, runs, "sensor_temperatures", [](auto const& d) -> auto const& { return d.readings; });
  add_group(
      panels, runs, "displacements", [](auto const& d) -> auto const& { return d.displacements; });
  add_heat(panels, runs);
  for (auto const& run : runs)
    for (auto const& axis : run.data.positioning)
      panels.push_back({fmt::format("positioning_{}_{}", run.stem(), axis.axis), positioning(axis)});
}

Eigen::VectorXd with_gaps(Json const& list) {
  Eigen::VectorXd values(Eigen::Index(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i)
    values[Eigen::Index(i)] = list[i].is_null() ? std::nan("") : list[i].get<double>();
  return values;
}

/// Heat of unknown course, of the first body, run after run, each with the band in which 95 % of it lies.
Figure free_heat(Json const& body) {
  double end = 0.0;
  for (auto const& run : body["runs"]) end = std::max(end, run["time_s"].back().get<double>());
  TimeFigure figure("Heat / W", 0.0, end);
  int number = 0;
  for (auto const& run : body["runs"]) {
    auto const time = with_gaps(run["time_s"]), watts = with_gaps(run["watts"]);
    Eigen::VectorXd const half = two_sided_95 * with_gaps(run["standard_error"]);
    figure.add_band(time, watts - half, watts + half);
    ++number;
    figure.add(body["runs"].size() > 1 ? fmt::format("run {}", number) : "", time, watts);
  }
  return figure.take();
}

Figure ranking(Json const& study, std::string const& world) {
  constexpr std::size_t most = 12;
  Figure figure;
  std::string unit;
  for (auto const& entry : study["worlds"])
    if (entry["name"] == world || unit.empty()) unit = entry["unit"].get<std::string>();
  figure.x_label = axis_text("RMSE on unseen runs", unit);
  for (auto const& row : study["combinations"]) {
    if (row["world"] != world || !row["figures"].contains("cross.rmse")) continue;
    auto const& of = row["figures"]["cross.rmse"];
    if (of["mean"].is_null()) continue;
    double const mean = of["mean"], half = of["half_width_95"];
    figure.rows.push_back({fmt::format("{} + {}", row["selection"].get<std::string>(), row["model"].get<std::string>()),
                           mean, mean - half, mean + half});
  }
  std::stable_sort(figure.rows.begin(), figure.rows.end(),
                   [](auto const& a, auto const& b) { return a.value < b.value; });
  if (figure.rows.size() > most) figure.rows.resize(most);
  return figure;
}

Figure functions(Json const& axis) {
  Figure figure;
  figure.x_label = axis["axis"].get<std::string>() + " / mm";
  figure.y_label = "Error / µm";
  for (char const* source : {"predicted_um", "true_um"}) {
    std::size_t i = 1;
    for (char const* component : {"x", "y", "z"}) {
      bool const truth = std::string_view(source) == "true_um";
      FigureLine line{fmt::format("{}{}", component, truth ? ", true" : ""), with_gaps(axis["position_mm"]),
                      with_gaps(axis[source][component])};
      output::set_style(line, i++);
      if (truth) line.dashes = {3.0, 2.0};
      figure.lines.push_back(line);
    }
  }
  return figure;
}

Figure drift(Json const& points) {
  TimeFigure figure("Largest error / µm", points.front()["time_s"], points.back()["time_s"]);
  Eigen::VectorXd time(Eigen::Index(points.size())), values = time;
  for (auto const& [key, name] :
       {std::pair{"moved_um", "moved since measured"}, std::pair{"uncompensated_um", "machine"},
        std::pair{"compensated_um", "compensated"}}) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      time[Eigen::Index(i)] = points[i]["time_s"];
      values[Eigen::Index(i)] = points[i][key];
    }
    figure.add(name, time, values);
  }
  return figure.take();
}

void add_answer_panels(std::vector<FigurePanel>& panels, std::filesystem::path const& path) {
  try {
    Json const answer = read_json(path);
    if (answer.contains("heat")) panels.push_back({"unknown_heat", free_heat(answer["heat"])});
    if (answer.contains("unaccounted_heat") && !answer["unaccounted_heat"].empty())
      panels.push_back({"unaccounted_heat", free_heat(answer["unaccounted_heat"][0])});
    std::set<std::string> worlds;
    if (answer.contains("combinations"))
      for (auto const& row : answer["combinations"]) worlds.insert(row["world"].get<std::string>());
    for (auto const& world : worlds)
      if (auto const figure = ranking(answer, world); !figure.rows.empty())
        panels.push_back({"ranking_" + file_part(world), figure});
    if (answer.contains("functions"))
      for (auto const& axis : answer["functions"])
        panels.push_back({"functions_" + axis["axis"].get<std::string>(), functions(axis)});
    if (answer.contains("drift") && !answer["drift"].empty()) panels.push_back({"drift", drift(answer["drift"])});
  } catch (Json::exception const& error) {
    throw no_answer(path, error);
  }
}

}  // namespace

std::vector<FigurePanel> figure_panels(std::vector<std::filesystem::path> const& files) {
  std::vector<FigurePanel> panels;
  std::vector<ShownRun> runs;
  for (auto const& file : files)
    if (file.extension() == ".json")
      add_answer_panels(panels, file);
    else
      runs.push_back(read_shown_run(file));
  name_distinctly(runs);
  if (!runs.empty()) add_runs(panels, std::move(runs));
  return panels;
}

}  // namespace thermotwin::twin
