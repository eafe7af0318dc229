#pragma once

#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "thermal/units.h"
#include "twin/axis_record.h"
#include "twin/file/schema.h"

namespace thermotwin::twin {

/// `[[world.instant]]`: an instant of a laser measurement at which the error over the axis is judged.
struct StudyInstant {
  std::string experiment;
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]

  /// As figures are called: "feed_8000 at 60 min".
  [[nodiscard]] std::string name() const { return fmt::format("{} at {:g} min", experiment, time / 60.0); }

  template <class Fields>
  static void fields(Fields& f) {
    f.name("experiment", &StudyInstant::experiment, "one of the world's");
    f("time", &StudyInstant::time, thermal::dimension::time, "of the laser's pass", Range{0.0});
  }
};

/// `[[world]]`: a machine, what it was put through, and the error that is to be predicted.
struct StudyWorld {
  std::string name, machine, added;
  std::vector<std::string> changes, train, test;
  std::optional<double> split;
  std::string error;
  std::vector<std::string> sensors;
  std::optional<double> sampling;
  std::string fit = "together";
  double from = 0.0, to = std::numeric_limits<double>::infinity();
  std::vector<StudyInstant> instants;
  Value table;  ///< where all this stands, for messages

  /// The error is the slope of an axis' position error, which a laser measures.
  [[nodiscard]] bool slope() const { return error.starts_with(slope_prefix); }

  template <class Fields>
  static void fields(Fields& f) {
    namespace dimension = thermal::dimension;
    f.name("name", &StudyWorld::name, "as the table shall call it");
    f("machine", &StudyWorld::machine,
      "name of a machine, or its file; left out: measured runs alone, without twins, thermal modes and experiments");
    f("set", &StudyWorld::changes,
      "parameters of the machine to change, as run --set: \"bearing.front.grease_factor=2\"");
    f("add", &StudyWorld::added, "tables to add to the machine, as they would stand in its file");
    f("train", &StudyWorld::train, "experiments or measured runs (.h5, .csv, .toml) that models are fitted to");
    f("test", &StudyWorld::test, "the ones that no model has seen");
    f("split", &StudyWorld::split, dimension::time, "train before it, test after it, on the one run in 'train'",
      Range{0.0});
    f.name("error", &StudyWorld::error,
           "displacement channel, or \"slope x\" for the slope of axis x's position error in the laser's passes");
    f("sensors", &StudyWorld::sensors, "candidates; default: all of the machine, or of the first run in 'train'");
    f("sampling", &StudyWorld::sampling, dimension::time,
      "interval of the readings, more than 0; measured ones are averaged over it, which must not be finer than the "
      "record's own; default: the experiment's, 1 min",
      Range{0.0});
    f.choice("fit", &StudyWorld::fit, {"together", "each"},
             "one model on all of 'train', or one on each, which then predicts the others");
    f("from", &StudyWorld::from, dimension::length, "judged positions of a laser: first", Range{0.0});
    f("to", &StudyWorld::to, dimension::length, "last", Range{0.0});
    f("instant", &StudyWorld::instants,
      "instants at which the error over the axis is judged; 'error' is a slope, 'fit' is together");
  }
};

/// What a claim may name in place of a world, and in place of a combination.
inline constexpr std::string_view mean_of_worlds = "mean of worlds";
inline constexpr std::string_view chosen_by_validation = "chosen by cross-validation";  ///< least validation.rmse
inline constexpr std::string_view best_of_papers = "best of papers";  ///< least of the figure, of the papers' methods

/// `[[claim]]`: what a paper says, put so that figures decide.
struct StudyClaim {
  std::string says, combination, than, figure = "cross.rmse", world;
  std::optional<double> at_most, improvement, tolerance, share;

  template <class Fields>
  static void fields(Fields& f) {
    namespace dimension = thermal::dimension;
    f.name("says", &StudyClaim::says, "the claim in words");
    f.name("combination", &StudyClaim::combination, "\"selection + model\", or \"chosen by cross-validation\"");
    f("than", &StudyClaim::than,
      "the other combination, or \"best of papers\"; 'combination' shall have less of 'figure', or more where more is "
      "better: r_squared, improvement, found, rank_correlation");
    f("figure", &StudyClaim::figure, "column of the table");
    f("world", &StudyClaim::world, "where; default: the first; \"mean of worlds\": in the mean of all");
    f("at_most", &StudyClaim::at_most, dimension::dimensionless, "in the figure's unit, in place of 'than'");
    f("improvement", &StudyClaim::improvement, dimension::dimensionless,
      "by how many percent better; default: better at all");
    f("tolerance", &StudyClaim::tolerance, dimension::dimensionless,
      "no worse than 'than', but by so many percent of 'figure' at most; 0: not worse; in place of 'improvement'",
      Range{0.0});
    f("share", &StudyClaim::share, dimension::dimensionless,
      "at most so much of 'than': 0.5 for half of it; in place of 'improvement'", Range{0.0});
  }
};

/// `[screening]`: how methods of selection look at readings (methods.md §3.2, §3.3, §4.2).
struct StudyScreening {
  std::string bins = "cellucci", edges = "equal_width", bias = "shuffle_null", normalisation = "across_sensors";
  int permutations = 199;
  double resolution = 0.0625;  ///< [K]

  template <class Fields>
  static void fields(Fields& f) {
    f.choice("bins", &StudyScreening::bins, {"cellucci", "sturges", "square_root", "freedman_diaconis"},
             "how many, on each axis, mutual information is counted in");
    f.choice("edges", &StudyScreening::edges, {"equal_width", "equal_frequency"}, "of these bins");
    f.choice("bias", &StudyScreening::bias, {"shuffle_null", "miller_madow", "none"}, "that is taken off");
    f("permutations", &StudyScreening::permutations, "that p values are of", Range{19, 100'000});
    f.choice(
        "normalisation", &StudyScreening::normalisation, {"across_sensors", "over_time", "z_score"},
        "of the readings that ordered clustering parts: at each instant to the range of the sensors, each sensor to "
        "its own range over time, or at each instant to the sensors' mean and deviation");
    f("resolution", &StudyScreening::resolution, thermal::dimension::temperature_difference,
      "of the readings: what a maximum or a pivot must be above", Range{0.0, 5.0});
  }
};

/// A study file: worlds × (selections × models, and single combinations beside them).
struct StudyDescription {
  std::string title, metric = "rmse", reference;
  std::vector<StudyWorld> worlds;
  std::vector<std::string> selections, models, also;
  int seeds = 5, folds = 0;
  StudyScreening screening;
  std::vector<StudyClaim> claims;

  template <class Fields>
  static void fields(Fields& f) {
    f("title", &StudyDescription::title, "one line for people");
    f("world", &StudyDescription::worlds, "machines, runs and errors");
    f("selections", &StudyDescription::selections,
      "\"all\"; methods of selection, with a number of sensors or without: \"grey_relational 2\"; a set of your own: "
      "\"sensors T1, T4\"");
    f("models", &StudyDescription::models,
      "methods of modelling; \"twin\": calibrated physics, driven by the inputs; \"twin METHOD\": what it errs by, "
      "from what its readings err by; \"twin observer\": corrected by its sensors; \"twin & ridge\": the mean of what "
      "both "
      "predict");
    f("also", &StudyDescription::also,
      "single combinations beside every selection with every model: \"all + twin observer\"");
    f("seeds", &StudyDescription::seeds, "how many times instruments and starts are drawn anew", Range{5, 1000});
    f("folds", &StudyDescription::folds, "of the blocked cross-validation within 'train'; 0: none", Range{0, 20});
    f("screening", &StudyDescription::screening, "how methods of selection look at readings");
    f.choice("metric", &StudyDescription::metric, {"rmse", "mae", "max"}, "that improvements are of");
    f("reference", &StudyDescription::reference, "combination that improvements are over; default: the first");
    f("claim", &StudyDescription::claims, "what figures shall decide");
  }
};

}  // namespace thermotwin::twin
