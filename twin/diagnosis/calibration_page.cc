#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "output/json_text.h"
#include "thermal/units.h"
#include "twin/diagnosis/calibration.h"
#include "twin/diagnosis/estimate_text.h"

namespace thermotwin::twin {
namespace {

using Json = nlohmann::ordered_json;

constexpr double collinear = 10.0;
constexpr double told_departure = 2.0;  // beyond it, people are told

std::string verdict_of(CalibratedNumber const& number) {
  std::string const text = number.implausible() ? "identified, implausible"
                           : number.identified  ? "identified"
                                                : "not identified: keep prior";
  if (number.departure() < told_departure) return text;
  return text + fmt::format("; {:.0f} prior deviations from the file", number.departure());
}

/// Of the number itself, in SI, where it may have either sign.
Json json_of(CalibratedNumber const& number) {
  bool const either = number.number.of_either_sign;
  return {{"path", number.number.path},
          {"unit", thermal::unit_of(number.number.dimension)},
          {"nominal", number.number.nominal},
          {"estimate", number.estimate()},
          {"standard_error", number.standard_error()},
          {either ? "prior_deviation" : "prior_deviation_of_logarithm", number.number.deviation},
          {either ? "deviation" : "deviation_of_logarithm", number.deviation},
          {"departure", number.departure()},
          {"written", number.number.value(number.written)},
          {"verdict", number.identified ? "identified" : "not identified"},
          {"implausible", number.implausible()}};
}

Json json_of(CalibratedInstrument const& instrument) {
  auto const& unit = instrument.unit;
  return {{"name", instrument.unknown.name},
          {"unit", unit},
          {"prior", in_unit(unit, instrument.unknown.mean)},
          {"prior_deviation", in_unit(unit, instrument.unknown.deviation)},
          {"estimate", in_unit(unit, instrument.estimate)},
          {"standard_error", in_unit(unit, instrument.standard_error)}};
}

Json json_of(ChannelGap const& gap) {
  return {{"run", gap.run},
          {"channel", gap.channel},
          {"unit", gap.unit},
          {"before", in_unit(gap.unit, gap.before)},
          {"after", in_unit(gap.unit, gap.after)}};
}

template <class Items>
Json list_of(Items const& items) {
  Json list = Json::array();
  for (auto const& item : items) list.push_back(json_of(item));
  return list;
}

/// How uncertain a number is before the data, as people read it.
std::string prior_text(UncertainNumber const& number) {
  return number.of_either_sign ? written_value(number.deviation, number.unit, 2)
                               : fmt::format("{:.0f} %", 100.0 * number.deviation);
}

std::string number_table(Calibration const& calibration) {
  std::string text = fmt::format("{:<42} {:>14} {:>14} {:>14} {:>10} {:>14}\n", "number", "nominal", "estimate",
                                 "std. error", "prior", "in the file");
  for (auto const& number : calibration.numbers) {
    auto const& of = number.number;
    double const written = of.value(number.written);
    text +=
        fmt::format("{:<42} {:>14} {:>14} {:>14} {:>10} {:>14}  {}\n", of.path, written_value(of.nominal, of.unit),
                    written_value(number.estimate(), of.unit, 4), written_value(number.standard_error(), of.unit, 2),
                    prior_text(of), written_value(written, of.unit, 4), verdict_of(number));
  }
  return text + fmt::format(
                    "prior: standard deviation before the data, of the logarithm where it is in %, else of the number. "
                    "Not identified:\nafter them it is still above {:.0f} % of that; such a number keeps its nominal "
                    "value. In the file: what is most\nprobable with those at nominal.\n",
                    100.0 * still_uncertain);
}

std::string implausible_text(Calibration const& calibration) {
  std::vector<std::string> paths;
  for (auto const& number : calibration.numbers)
    if (number.implausible()) paths.push_back(number.number.path);
  if (paths.empty()) return "";
  return fmt::format(
      "implausible, in the file beyond {:g} prior deviations of yours or of another sign than the estimate, standing "
      "in "
      "for other numbers or for what is missing: {}\n",
      far_from_file, fmt::join(paths, ", "));
}

std::string instrument_table(Calibration const& calibration) {
  std::string text = fmt::format("{:<42} {:>14} {:>14}\n", "instrument or run", "estimate", "std. error");
  for (auto const& instrument : calibration.instruments) {
    auto const& unit = instrument.unit;
    text += fmt::format("{:<42} {:>11.3f} {:<4} {:>11.3f} {}\n", instrument.unknown.name,
                        in_unit(unit, instrument.estimate), unit, in_unit(unit, instrument.standard_error), unit);
  }
  return text;
}

std::string collinearity_text(Calibration const& calibration) {
  std::string text;
  for (auto const& group : calibration.inseparable)
    text += fmt::format("inseparable (correlation above {:g}): {}\n", tied, fmt::join(group, ", "));
  if (calibration.collinearity == 0.0) return text + "These data identify no number.\n";
  text += fmt::format("collinearity index of the identified numbers: {:.1f}", calibration.collinearity);
  if (calibration.collinearity <= collinear) return text + "\n";
  return text + fmt::format(", above {:.0f}; most of it: {}\n", collinear, fmt::join(calibration.weakest, ", "));
}

std::string advice(Calibration const& calibration) {
  auto const reasons = calibration.shortcomings();
  if (reasons.empty()) return "whether an effect is missing, `diagnose` tells";
  return fmt::format("numbers alone do not explain the data ({}): ask `diagnose` what is missing",
                     fmt::join(reasons, "; "));
}

std::string gap_table(Calibration const& calibration) {
  std::string text =
      fmt::format("{:<20} {:<12} {:>10} {:>10}    error of the twin, RMS\n", "run", "channel", "before", "after");
  for (auto const& gap : calibration.gaps)
    text += fmt::format("{:<20} {:<12} {:>10.3f} {:>10.3f} {}\n", gap.run, gap.channel, in_unit(gap.unit, gap.before),
                        in_unit(gap.unit, gap.after), gap.unit);
  auto const sum = whole(calibration.gaps);
  text += fmt::format("all channels, in units of 0.1 K and 1 um: {:.2f} before, {:.2f} after\n", sum.before, sum.after);
  return text;
}

}  // namespace

std::string calibration_table(Calibration const& calibration) {
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n", doubt_lines(calibration.doubts),
                                 number_table(calibration) + implausible_text(calibration),
                                 instrument_table(calibration), collinearity_text(calibration), gap_table(calibration));
  text += fmt::format("misfit: {:.2f} of what the expected noise makes; {}\n", calibration.misfit, advice(calibration));
  if (!calibration.converged) text += "note: the fit did not converge; the estimates are where it stopped\n";
  for (auto const& remark : calibration.remarks) text += "note: " + remark + "\n";
  return text;
}

std::string calibration_json(Calibration const& calibration) {
  auto const sum = whole(calibration.gaps);
  Json const json = {{"machine", calibration.machine},
                     {"numbers", list_of(calibration.numbers)},
                     {"instruments", list_of(calibration.instruments)},
                     {"inseparable", calibration.inseparable},
                     {"collinearity", calibration.collinearity},
                     {"weakest_direction", calibration.weakest},
                     {"misfit", calibration.misfit},
                     {"falls_short", calibration.falls_short()},
                     {"shortcomings", calibration.shortcomings()},
                     {"converged", calibration.converged},
                     {"gap", {{"before", sum.before}, {"after", sum.after}}},
                     {"gaps", list_of(calibration.gaps)},
                     {"remarks", calibration.remarks},
                     {"doubts", doubts_json(calibration.doubts)}};
  return output::json_text(json);
}

}  // namespace thermotwin::twin
