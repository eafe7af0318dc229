#include "output/json_text.h"

#include <nlohmann/json.hpp>

#include "thermal/units.h"

namespace thermotwin::output {
namespace {

void without_last_bits(nlohmann::ordered_json& value) {
  if (value.is_number_float()) value = thermal::without_rounding(value.get<double>());
  if (value.is_structured())
    for (auto& part : value) without_last_bits(part);
}

}  // namespace

std::string json_text(nlohmann::ordered_json report) {
  without_last_bits(report);
  return report.dump(2) + "\n";
}

}  // namespace thermotwin::output
