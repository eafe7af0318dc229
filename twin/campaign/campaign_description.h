#pragma once

#include <optional>
#include <string>
#include <vector>

#include "thermal/units.h"
#include "twin/file/schema.h"
#include "twin/run.h"

namespace thermotwin::twin {

/// `[[grid]]`: a parameter that takes each of its values with each of all others.
struct GridDescription {
  std::string path, from, to, scale = "linear";
  std::vector<std::string> values;
  int count = 0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("path", &GridDescription::path, "of the parameter, as run --set has it: bearing.front.grease_factor");
    f("values", &GridDescription::values, "the values, one by one");
    f("from", &GridDescription::from, "or the first of evenly spaced values");
    f("to", &GridDescription::to, "the last, in the same unit");
    f("count", &GridDescription::count, "how many", Range{0.0, 1e9});
    f.choice("scale", &GridDescription::scale, {"linear", "log"}, "even spacing of the values or of their logarithms");
  }
};

/// `[[latin_hypercube.vary]]`: a parameter that is drawn from a range.
struct VariedDescription {
  std::string path, from, to, scale = "linear";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("path", &VariedDescription::path, "of the parameter, as run --set has it");
    f.name("from", &VariedDescription::from, "lowest value");
    f.name("to", &VariedDescription::to, "highest value, in the same unit");
    f.choice("scale", &VariedDescription::scale, {"linear", "log"}, "drawn evenly, or evenly in the logarithm");
  }
};

/// `[latin_hypercube]`: parameters drawn together, so that each is spread evenly over its range.
struct LatinHypercubeDescription {
  int count = 0, seed = 1;
  std::vector<VariedDescription> vary;

  template <class Fields>
  static void fields(Fields& f) {
    f("count", &LatinHypercubeDescription::count, "how many samples", Range{1.0, 1e9});
    f("seed", &LatinHypercubeDescription::seed, "the same seed draws the same samples", Range{0.0, 2147483647.0});
    f("vary", &LatinHypercubeDescription::vary, "the parameters");
  }
};

/// `[[case]]`: settings that belong together.
struct CaseDescription {
  std::vector<std::string> set;

  template <class Fields>
  static void fields(Fields& f) {
    f("set", &CaseDescription::set, "parameters of this case: \"bearing.front.grease_factor=0.8\"");
  }
};

/// A campaign file: grid × samples × cases × experiments × repetitions.
struct CampaignDescription {
  std::string title, machine, model = "full";
  std::vector<std::string> experiments, set, keep = {"readings", "displacements", "inputs"};
  int repetitions = 1, seed = 1, part = 0;
  std::optional<double> every;
  double tolerance = 1e-5;
  std::vector<GridDescription> grid;
  std::optional<LatinHypercubeDescription> latin_hypercube;
  std::vector<CaseDescription> cases;

  template <class Fields>
  static void fields(Fields& f) {
    f("title", &CampaignDescription::title, "one line for people");
    f("experiments", &CampaignDescription::experiments, "files, or names of the catalogue");
    f("machine", &CampaignDescription::machine, "file or name; default: the one that the first experiment names");
    f.choice(
        "model", &CampaignDescription::model, {"full", "modes", "reduced"},
        "of the machine: all its nodes; all, by exponential steps in its modes, faster where speeds change often; or "
        "few shapes of them, whose bound is kept of each run");
    f("set", &CampaignDescription::set, "parameters changed in every run, as run --set has them");
    f("grid", &CampaignDescription::grid, "parameters of which every value meets every other");
    f("latin_hypercube", &CampaignDescription::latin_hypercube, "parameters drawn together from ranges");
    f("case", &CampaignDescription::cases, "settings that belong together, one by one");
    f("repetitions", &CampaignDescription::repetitions, "how often each is run, with other instruments",
      Range{1.0, 1e9});
    f("seed", &CampaignDescription::seed, "of the instruments of run 0; run i has seed + i", Range{0.0, 1e9});
    f("every", &CampaignDescription::every, thermal::dimension::time,
      "interval of the readings; default: that of the experiments", Range{0.0});
    f("keep", &CampaignDescription::keep,
      "what stays of each run: readings, displacements, inputs, truth (both without the instruments' errors), summary "
      "(first, last, lowest and highest of both)");
    f("tolerance", &CampaignDescription::tolerance, thermal::dimension::dimensionless,
      "relative tolerance of the integration; a reduced model has its own",
      Range{finest_tolerance, coarsest_tolerance});
    f("part", &CampaignDescription::part, "runs per file; default: a 256th of all, at most 1000", Range{0.0, 1e6});
  }
};

}  // namespace thermotwin::twin
