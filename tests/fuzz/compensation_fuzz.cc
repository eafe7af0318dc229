// libFuzzer: bytes become messages, with topic, time of arrival and payload; the offset must keep its limits.
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "twin/compensation/compensation_loop.h"

namespace {

using namespace thermotwin::twin;

constexpr ShiftLimits limits{1.0, 1.0, 0.5, 20.0};

CompensationLoop loop() {
  thermotwin::models::LinearForm form;
  form.lags = {0, 2};
  form.coefficients = (Eigen::Matrix2d() << 3.0, -40.0, 1.0, 5.0).finished();
  Compensator compensator(SavedModel({"linear", {"T1", "T2"}, 10.0, 3.0, form, ""}), {limits, {}, {60.0, 60.0}});
  return {std::move(compensator), {1.0, 1.0, 30.0, 30.0}};
}

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

/// Messages end with a zero byte; the first byte chooses the topic, the second how much later it comes [s/16].
extern "C" int LLVMFuzzerTestOneInput(unsigned char const* data, std::size_t size) {
  auto fuzzed = loop();
  auto const topics = fuzzed.topics();
  std::string_view rest(reinterpret_cast<char const*>(data), size);
  double wall = 0.0, travelled = 0.0, last = 0.0;
  while (rest.size() > 2) {
    auto const end = std::min(rest.find('\0', 2), rest.size());
    std::string const topic = rest[0] % 3 == 2 ? std::string(rest.substr(2, 5)) : topics[std::size_t(rest[0] & 1)];
    wall += double(static_cast<unsigned char>(rest[1])) / 16.0;
    if (auto const decision = fuzzed.take(topic, rest.substr(2, end - 2), wall)) {
      travelled += std::abs(decision->offset - last);
      last = decision->offset;
      require(std::abs(last) <= limits.largest && last == std::round(last));
      require(travelled <= limits.slew * wall + limits.resolution + 1e-9);
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return 0;
}
