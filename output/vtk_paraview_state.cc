#include <array>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "output/atomic_file.h"
#include "output/paraview_state.h"
#include "output/vtk_grid.h"
#include "output/vtk_view.h"

namespace thermotwin::output {
namespace {

using Texts = std::vector<std::string>;

Eigen::Vector3d const marker_red(0.86, 0.15, 0.15), unknown_grey(0.75, 0.75, 0.75);

enum Id {
  fields = 1,
  deformed,
  sensors,
  colours,
  machine_shown,
  sensors_shown,
  colour_bar,
  view,
  layout,
  times,
  scene
};

/// One proxy of the state, with its properties.
class Proxy {
 public:
  Proxy(char const* group, char const* type, Id id)
      : text_(fmt::format("<Proxy group=\"{}\" type=\"{}\" id=\"{}\" servers=\"21\">\n", group, type, int(id))),
        id_(id) {}

  Proxy& set(char const* name, Texts const& values) {
    begin(name, values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      text_ += fmt::format("<Element index=\"{}\" value=\"{}\"/>", i, values[i]);
    text_ += "</Property>\n";
    return *this;
  }
  Proxy& set(char const* name, Eigen::Vector3d const& values) {
    return set(name, Texts{number(values[0]), number(values[1]), number(values[2])});
  }
  Proxy& set(char const* name, std::string const& value) { return set(name, Texts{value}); }
  Proxy& refer(char const* name, std::vector<Id> const& others) {
    begin(name, others.size());
    for (Id const other : others) text_ += fmt::format("<Proxy value=\"{}\" output_port=\"0\"/>", int(other));
    text_ += "</Property>\n";
    return *this;
  }
  /// The whole window.
  Proxy& fill_with(Id view) {
    text_ += fmt::format(
        "<Layout number_of_elements=\"1\"><Item direction=\"0\" fraction=\"0.5\" view=\"{}\"/></Layout>\n", int(view));
    return *this;
  }

  static std::string number(double value) { return fmt::format("{:.9g}", value); }
  [[nodiscard]] std::string text() const { return text_ + "</Proxy>\n"; }

 private:
  void begin(char const* name, std::size_t count) {
    text_ += fmt::format("<Property name=\"{}\" id=\"{}.{}\" number_of_elements=\"{}\">", name, int(id_), name, count);
  }

  std::string text_;
  Id id_;
};

std::string escaped(std::string const& path) {
  std::string text;
  for (char const c : path) text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return text;
}

using Colours = std::vector<std::array<double, 3>>;

Colours const blue_to_yellow = {
    {0.267, 0.005, 0.329}, {0.230, 0.322, 0.546}, {0.128, 0.567, 0.551}, {0.369, 0.789, 0.383}, {0.993, 0.906, 0.144}};
Colours const blue_white_red = {
    {0.020, 0.188, 0.380}, {0.263, 0.576, 0.765}, {0.969, 0.969, 0.969}, {0.839, 0.376, 0.302}, {0.404, 0.0, 0.122}};

Texts spread(Colours const& colours_of_map, double low, double high) {
  Texts texts;
  for (std::size_t i = 0; i < colours_of_map.size(); ++i) {
    texts.push_back(Proxy::number(low + (high - low) * double(i) / double(colours_of_map.size() - 1)));
    for (double const part : colours_of_map[i]) texts.push_back(Proxy::number(part));
  }
  return texts;
}

std::string collection(char const* name, std::vector<std::pair<Id, char const*>> const& items) {
  std::string text = fmt::format("<ProxyCollection name=\"{}\">\n", name);
  for (auto const& [id, title] : items) text += fmt::format("<Item id=\"{}\" name=\"{}\"/>\n", int(id), title);
  return text + "</ProxyCollection>\n";
}

bool is_deformed(ParaviewView const& how) { return !field_names(how.meaning).displacement.empty(); }

std::string sensor_proxies(ParaviewView const& how) {
  Proxy shown("representations", "GeometryRepresentation", sensors_shown);
  shown.refer("Input", {sensors})
      .set("Representation", "Points")
      .set("PointSize", "18")
      .set("RenderPointsAsSpheres", "1");
  if (how.meaning == FieldMeaning::state)
    return shown.set("AmbientColor", marker_red).set("DiffuseColor", marker_red).text();
  return shown.set("ColorArrayName", Texts{"", "", "", "0", field_names(how.meaning).temperature})
      .refer("LookupTable", {colours})
      .text();
}

char const* title_of(FieldMeaning meaning) {
  if (meaning == FieldMeaning::state) return "Temperature / °C";
  return meaning == FieldMeaning::difference ? "Difference / K" : "Residual / K";
}

std::string colour_bar_proxy(ParaviewView const& how) {
  Eigen::Vector3d const black(0.0, 0.0, 0.0);
  return Proxy("representations", "ScalarBarWidgetRepresentation", colour_bar)
      .refer("LookupTable", {colours})
      .set("Visibility", "1")
      .set("Title", title_of(how.meaning))
      .set("ComponentTitle", "")
      .set("TitleColor", black)
      .set("LabelColor", black)
      .set("AutomaticLabelFormat", "0")
      .set("LabelFormat", "%-#.3g")
      .set("RangeLabelFormat", "%-#.3g")
      .text();
}

/// Without these, ParaView's controls have no times to play.
std::string time_proxies(ParaviewView const& how) {
  return Proxy("misc", "TimeKeeper", times)
             .refer("TimeSources", how.with_sensors ? std::vector{fields, sensors} : std::vector{fields})
             .text() +
         Proxy("animation", "AnimationScene", scene)
             .set("PlayMode", "2")  // from time to time
             .set("StartTime", Proxy::number(how.first_s))
             .set("EndTime", Proxy::number(how.last_s))
             .refer("TimeKeeper", {times})
             .refer("ViewModules", {view})
             .text();
}

std::string shown_proxies(ParaviewView const& how) {
  Eigen::Vector3d const from = axes_of_view(how.up) * Eigen::Vector3d(0.75, -1.0, 0.62).normalized();
  return Proxy("lookup_tables", "PVLookupTable", colours)
             .set("RGBPoints", spread(how.meaning == FieldMeaning::state ? blue_to_yellow : blue_white_red,
                                      how.lowest_degC, how.highest_degC))
             .set("ColorSpace", "0")
             .set("NanColor", unknown_grey)
             .set("ScalarRangeInitialized", "1")
             .text() +
         Proxy("representations", "UnstructuredGridRepresentation", machine_shown)
             .refer("Input", {is_deformed(how) ? deformed : fields})
             .set("Representation", "Surface")
             .set("Opacity", "0.3")
             .set("ColorArrayName", Texts{"", "", "", "1", field_names(how.meaning).temperature})
             .refer("LookupTable", {colours})
             .text() +
         (how.with_sensors ? sensor_proxies(how) : std::string()) + colour_bar_proxy(how) +
         Proxy("views", "RenderView", view)
             .refer("Representations", how.with_sensors ? std::vector{machine_shown, sensors_shown, colour_bar}
                                                        : std::vector{machine_shown, colour_bar})
             .set("CameraFocalPoint", how.centre)
             .set("CameraPosition", Eigen::Vector3d(how.centre + 3.0 * how.size * from))
             .set("CameraViewUp", how.up)
             .set("CameraParallelProjection", "1")
             .set("CameraParallelScale", Proxy::number(0.5 * how.size))
             .set("UseColorPaletteForBackground", "0")
             .set("Background", Eigen::Vector3d(1.0, 1.0, 1.0))
             .text() +
         Proxy("misc", "ViewLayout", layout).fill_with(view).text();
}

}  // namespace

void write_paraview_state(std::filesystem::path const& directory, ParaviewView const& how) {
  auto const path = [&](char const* file) { return escaped(std::filesystem::absolute(directory / file).string()); };
  std::string text = "<ParaView>\n<ServerManagerState version=\"5.11.0\">\n" +
                     Proxy("sources", "PVDReader", fields).set("FileName", path("fields.pvd")).text();
  if (is_deformed(how))
    text += Proxy("filters", "WarpVector", deformed)
                .refer("Input", {fields})
                .set("SelectInputVectors", Texts{"0", "0", "0", "0", field_names(how.meaning).displacement})
                .set("ScaleFactor", Proxy::number(1e-6 * how.magnification))
                .text();
  if (how.with_sensors) text += Proxy("sources", "PVDReader", sensors).set("FileName", path("sensors.pvd")).text();
  text += shown_proxies(how) + time_proxies(how);
  std::vector<std::pair<Id, char const*>> sources = {{fields, "fields"}};
  if (is_deformed(how)) sources.emplace_back(deformed, "deformed");
  std::vector<std::pair<Id, char const*>> pictures = {{machine_shown, "machine"}};
  if (how.with_sensors) {
    sources.emplace_back(sensors, "sensors");
    pictures.emplace_back(sensors_shown, "sensors");
  }
  std::string const table = fmt::format("1.{}.PVLookupTable", field_names(how.meaning).temperature);
  text += collection("sources", sources) + collection("representations", pictures) +
          collection("lookup_tables", {{colours, table.c_str()}}) +
          collection("scalar_bars", {{colour_bar, "colours"}}) + collection("views", {{view, "machine"}}) +
          collection("layouts", {{layout, "machine"}}) + collection("timekeeper", {{times, "times"}}) +
          collection("animation", {{scene, "scene"}}) + "</ServerManagerState>\n</ParaView>\n";
  write_atomically(directory / "arranged.pvsm", text);
}

}  // namespace thermotwin::output
