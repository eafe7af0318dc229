#pragma once

#include <gtest/gtest.h>
#include <string>

#include "tests/output/temporary_directory.h"
#include "twin/machine.h"

/// Pieces of files for `thermotwin check`.
namespace thermotwin::tests {

constexpr char const* experiment = "machine = \"v450\"\nduration = \"1 h\"\n";

/// The air of an hour; the channel that it is taken for is left open.
constexpr char const* air = "time_s,room\n0,20\n600,20.5\n1200,21\n1800,21.5\n2400,22\n3000,22.5\n3600,23\n";
inline std::string recorded(std::string const& channel) {
  return "[[recorded]]\nfile = \"air.csv\"\ncolumns = [{column = \"room\", channel = \"" + channel +
         "\", unit = \"degC\"}]\n";
}

/// The lumped machine with one thing more.
inline std::string machine_with(std::string const& table) { return contents(twin::machine_file("v450")) + table; }

/// A shipped machine with one text in place of another, its first.
inline std::string machine_changed(std::string const& name, std::string const& old, std::string const& fresh) {
  auto text = contents(twin::machine_file(name));
  EXPECT_NE(text.find(old), std::string::npos) << old;
  return text.replace(text.find(old), old.size(), fresh);
}

}  // namespace thermotwin::tests
