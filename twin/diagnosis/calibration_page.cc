#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "thermal/units.h"
#include "twin/diagnosis/calibration.h"
#include "twin/diagnosis/estimate_text.h"

namespace thermotwin::twin {
namespace {

using Json = nlohmann::ordered_json;

constexpr double collinear = 10.0;
constexpr double told_departure = 2.0;  // beyond it, people are told

std::string verdict_of(CalibratedNumber const& number) {
  std::string const text = number.identified ? "identified" : "not identified: keep prior";
  if (number.departure() < told_departure) return text;
  return text + fmt::format("; {:.0f} prior deviations from the file", number.departure());
}

double si_to_people(CalibratedInstrument const& instrument) { return instrument.unit.starts_with("u") ? 1e6 : 1.0; }

Json json_of(CalibratedNumber const& number) {
  return {{"path", number.number.path},
          {"unit", thermal::unit_of(number.number.dimension)},
          {"nominal", number.number.nominal},
          {"estimate", number.estimate()},
          {"standard_error", number.standard_error()},
          {"prior_deviation_of_logarithm", number.number.deviation},
          {"deviation_of_logarithm", number.deviation},
          {"departure", number.departure()},
          {"written", number.number.value(number.written)},
          {"verdict", number.identified ? "identified" : "not identified"}};
}

Json json_of(CalibratedInstrument const& instrument) {
  double const scale = si_to_people(instrument);
  return {{"name", instrument.unknown.name},          {"unit", instrument.unit},
          {"prior", scale * instrument.unknown.mean}, {"prior_deviation", scale * instrument.unknown.deviation},
          {"estimate", scale * instrument.estimate},  {"standard_error", scale * instrument.standard_error}};
}

Json json_of(ChannelGap const& gap) {
  double const scale = gap.displacement ? 1e6 : 1.0;
  return {{"run", gap.run},
          {"channel", gap.channel},
          {"unit", gap.unit},
          {"before", scale * gap.before},
          {"after", scale * gap.after}};
}

template <class Items>
Json list_of(Items const& items) {
  Json list = Json::array();
  for (auto const& item : items) list.push_back(json_of(item));
  return list;
}

std::string number_table(Calibration const& calibration) {
  std::string text = fmt::format("{:<42} {:>14} {:>14} {:>14} {:>6} {:>14}\n", "number", "nominal", "estimate",
                                 "std. error", "prior", "in the file");
  for (auto const& number : calibration.numbers) {
    auto const& of = number.number;
    double const written = of.value(number.written);
    text +=
        fmt::format("{:<42} {:>14} {:>14} {:>14} {:>4.0f} % {:>14}  {}\n", of.path, written_value(of.nominal, of.unit),
                    written_value(number.estimate(), of.unit, 4), written_value(number.standard_error(), of.unit, 2),
                    100.0 * of.deviation, written_value(written, of.unit, 4), verdict_of(number));
  }
  return text +
         "prior: standard deviation of the logarithm before the data. Not identified: after them it is still above "
         "half "
         "of\nthat; such a number keeps its nominal value. In the file: what is most probable with those at nominal.\n";
}

std::string instrument_table(Calibration const& calibration) {
  std::string text = fmt::format("{:<42} {:>14} {:>14}\n", "instrument or run", "estimate", "std. error");
  for (auto const& instrument : calibration.instruments) {
    double const scale = si_to_people(instrument);
    text += fmt::format("{:<42} {:>11.3f} {:<4} {:>11.3f} {}\n", instrument.unknown.name, scale * instrument.estimate,
                        instrument.unit, scale * instrument.standard_error, instrument.unit);
  }
  return text;
}

std::string collinearity_text(Calibration const& calibration) {
  std::string text;
  for (auto const& group : calibration.inseparable)
    text += fmt::format("inseparable (correlation above 0.95): {}\n", fmt::join(group, ", "));
  if (calibration.collinearity == 0.0) return text + "These data identify no number.\n";
  text += fmt::format("collinearity index of the identified numbers: {:.1f}", calibration.collinearity);
  if (calibration.collinearity <= collinear) return text + "\n";
  return text + fmt::format(", above {:.0f}; most of it: {}\n", collinear, fmt::join(calibration.weakest, ", "));
}

std::string advice(Calibration const& calibration) {
  auto const sum = whole(calibration.gaps);
  if (sum.after > sum.before)
    return "the calibrated file is further from the data than yours: ask `diagnose` what is missing";
  return calibration.falls_short() ? "numbers alone do not explain the data: ask `diagnose` what is missing"
                                   : "whether an effect is missing, `diagnose` tells";
}

std::string gap_table(Calibration const& calibration) {
  std::string text =
      fmt::format("{:<20} {:<12} {:>10} {:>10}    error of the twin, RMS\n", "run", "channel", "before", "after");
  for (auto const& gap : calibration.gaps) {
    double const scale = gap.displacement ? 1e6 : 1.0;
    text += fmt::format("{:<20} {:<12} {:>10.3f} {:>10.3f} {}\n", gap.run, gap.channel, scale * gap.before,
                        scale * gap.after, gap.unit);
  }
  auto const sum = whole(calibration.gaps);
  text += fmt::format("all channels, in units of 0.1 K and 1 um: {:.2f} before, {:.2f} after\n", sum.before, sum.after);
  return text;
}

}  // namespace

std::string calibration_table(Calibration const& calibration) {
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n", doubt_lines(calibration.doubts), number_table(calibration),
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
                     {"converged", calibration.converged},
                     {"gap", {{"before", sum.before}, {"after", sum.after}}},
                     {"gaps", list_of(calibration.gaps)},
                     {"remarks", calibration.remarks},
                     {"doubts", doubts_json(calibration.doubts)}};
  return json.dump(2) + "\n";
}

}  // namespace thermotwin::twin
