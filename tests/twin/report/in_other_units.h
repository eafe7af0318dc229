#pragma once

#include <filesystem>
#include <fmt/format.h>
#include <string>

#include "output/dataset.h"
#include "tests/output/temporary_directory.h"

namespace thermotwin::tests {

/// The same data as somebody else's table with its measurement file, `other.toml`: temperatures in K, displacements in
/// mm and mrad, the speed in rad/s. `head` is the beginning of that file.
inline std::filesystem::path put_in_other_units(output::Dataset const& data, TemporaryDirectory const& folder,
                                                std::string const& head = "") {
  constexpr double rad_per_s = 0.10471975511965977;  // of a revolution per minute
  struct Column {
    output::Channel const* channel;
    double factor, offset;
  };
  std::vector<Column> columns;
  std::string inputs, readings, table = "t";
  auto const add = [&](std::string& list, char const* key, output::Channel const& channel, char const* unit,
                       double factor, double offset = 0.0) {
    list += fmt::format("  {{column = \"{0}\", {1} = \"{0}\", unit = \"{2}\"}},\n", channel.name, key, unit);
    table += "," + channel.name;
    columns.push_back({&channel, factor, offset});
  };
  for (auto const& input : data.inputs) {
    if (input.name == "spindle.speed") add(inputs, "channel", input, "rad/s", rad_per_s);
    if (input.name == "ambient.temperature") add(inputs, "channel", input, "K", 1.0, 273.15);
  }
  for (auto const& reading : data.readings) add(readings, "sensor", reading, "K", 1.0, 273.15);
  for (auto const& channel : data.displacements)
    add(readings, "sensor", channel, channel.unit == "um" ? "mm" : "mrad", 1e-3);
  for (Eigen::Index row = 0; row < data.time_s.size(); ++row) {
    table += fmt::format("\n{}", data.time_s[row]);
    for (auto const& [channel, factor, offset] : columns)
      table += fmt::format(",{}", factor * channel->values[row] + offset);
  }
  put(folder / "other.csv", table + "\n");
  put(folder / "other.toml",
      fmt::format("{}\n[[table]]\nfile = \"other.csv\"\ntime_column = \"t\"\ninput = [\n{}]\nreading = [\n{}]\n", head,
                  inputs, readings));
  return folder / "other.toml";
}

}  // namespace thermotwin::tests
