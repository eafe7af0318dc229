#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "twin/file/value.h"
#include "twin/study/study_description.h"

namespace thermotwin::twin {

/// The method of selection that asks a machine's file for its thermal modes.
inline constexpr std::string_view modes_method = "thermal_modes";

/// "grey_relational 2": a method of selection, and how many sensors it shall choose; "sensors T1, T4": these.
struct NamedSelection {
  std::string name;                    ///< of models::selection_methods(), "all", or "sensors"
  std::optional<int> count;            ///< none: the method's own rule
  std::vector<std::string> sensors{};  ///< for "sensors"

  [[nodiscard]] bool needs_machine() const { return name == modes_method; }
};

/// InputError for an unknown method, with the nearest; for a count that is no number from 1 on; for "all" with one; for
/// a list of sensors with a gap or a name given twice.
[[nodiscard]] NamedSelection named_selection(std::string const& text);

/// What the calibrated twin is called that no model helps.
inline constexpr std::string_view twin_alone = "twin";

/// What a twin is called that its sensors correct while it runs.
inline constexpr std::string_view observer_method = "observer";

/// "ridge", "twin", "twin ridge" or "twin observer": a method on the readings; the calibrated twin (study_twin.h),
/// driven by the inputs; a method that learns from the readings what the twin does not know; the twin, its state
/// corrected by the readings.
struct NamedModel {
  bool twin = false;
  std::string method;  ///< of models::model_methods(), or observer_method; empty: the twin alone

  [[nodiscard]] bool observes() const { return twin && method == observer_method; }

  bool operator==(NamedModel const&) const = default;
};

/// One of them. std::invalid_argument for an unknown method, with the nearest.
[[nodiscard]] NamedModel named_model(std::string const& text);

/// "ridge", or "twin & ridge": several models, whose answers are averaged. Means of forecasts from different knowledge
/// err less than most of those they are of, and need no choice between them (Bates & Granger 1969, Oper. Res. Q. 20,
/// 451). std::invalid_argument for an unknown method, with the nearest; for a model given twice.
[[nodiscard]] std::vector<NamedModel> named_models(std::string const& text);

/// Whether one of them is a twin.
[[nodiscard]] bool need_machine(std::vector<NamedModel> const& models);

/// A study file as its author wrote it.
struct Study {
  StudyDescription description;
  std::filesystem::path directory;  ///< of the file: names of files in it start here
  Value document{};                 ///< as read: where its words stand
};

/// A complaint says where in this table of the study's file what it quotes stands, if there is one.
[[nodiscard]] thermal::InputError about(Value const& table, std::string const& complaint,
                                        std::string const& before = "");
/// One about a world says which, too.
[[nodiscard]] thermal::InputError about(StudyWorld const& world, std::string const& complaint);

/// FileError with line and column: unknown keys, methods, combinations and figures of claims; no world, selection or
/// model; names given twice; a world without anything to test on; what needs a machine where no world, or not the
/// claim's, names one; a claim against the papers' best in a study without their methods.
[[nodiscard]] Study read_study(std::filesystem::path const& file);

/// A study file, or the name of one in scenarios/studies; InputError with the nearest name.
[[nodiscard]] std::filesystem::path study_file(std::string const& name_or_path);

/// "selection + model", as tables and claims write it.
[[nodiscard]] std::string combination_name(std::string const& selection, std::string const& model);

}  // namespace thermotwin::twin
