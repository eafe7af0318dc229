// thermotwin_block NX NY NZ RTOL [FILE]: the block of course.h by thermal::integrate. Prints one line of JSON; FILE
// receives the temperature rise of all cells at the end of each piece, as doubles.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/benchmarks/block/course.h"
#include "tests/benchmarks/block/peak_memory.h"
#include "thermal/integrate.h"
#include "thermal/laws.h"

namespace thermotwin::block {
namespace {

using namespace thermal;

class Heat final : public Course {
 public:
  std::vector<InputChannel> const& channels() const override { return channels_; }
  void evaluate(double t, std::span<double> values) const override {
    std::size_t piece = 0;
    while (piece + 1 < until.size() && t >= until[piece]) ++piece;
    values[0] = watts[piece];
  }
  double next_jump(double t) const override {
    for (double const end : until)
      if (end > t) return end;
    return 1e30;
  }

 private:
  std::vector<InputChannel> channels_{{"heat", "W", "heat into the row of cells"}};
};

Network network(std::array<int, 3> const& n) {
  NetworkBuilder builder;
  int const part = builder.part("block");
  std::array<double, 3> step{};
  for (std::size_t d = 0; d < 3; ++d) step[d] = size[d] / n[d];
  double const volume = step[0] * step[1] * step[2];
  int const count = n[0] * n[1] * n[2];
  builder.add_body("block", std::vector<double>(std::size_t(count), density * specific_heat * volume));
  Port const outside = builder.add_boundary({"room", room, {}});
  std::array<int, 3> const stride{1, n[0], n[0] * n[1]};
  for (int node = 0; node < count; ++node)
    for (std::size_t d = 0; d < 3; ++d) {
      int const place = node / stride[d] % n[d];
      double const area = volume / step[d];
      Port const here{Port::Kind::node, node};
      if (place + 1 < n[d])
        builder.connect(part, here, {Port::Kind::node, node + stride[d]}, conductivity * area / step[d]);
      for (bool const at_face : {place == 0, place + 1 == n[d]})
        if (at_face) builder.connect(part, here, outside, film * area);
    }
  auto const heated = heated_cells(n);
  for (int const cell : heated)
    builder.add<SwitchedHeat>(part, {{Port::Kind::node, cell}}, {1.0 / double(heated.size())},
                              {builder.channel("heat")});
  return builder.build();
}

int run(int argc, char** argv) {
  if (argc < 5) return std::puts("thermotwin_block NX NY NZ RTOL [FILE]"), 2;
  std::array<int, 3> const n{std::atoi(argv[1]), std::atoi(argv[2]), std::atoi(argv[3])};
  auto const clock = [] { return std::chrono::steady_clock::now(); };
  auto const begin = clock();
  Network const net = network(n);
  std::chrono::duration<double> const building = clock() - begin;
  IntegrationOptions options;
  options.relative_tolerance = std::atof(argv[4]);
  options.absolute_tolerance = 0.0;
  std::vector<double> times;
  for (double t = 0.0; t <= until.back(); t += output_interval) times.push_back(t);
  std::ofstream file;
  if (argc > 5) file.open(argv[5], std::ios::binary);
  std::vector<double> const start(std::size_t(net.nodes()), room);
  std::vector<double> rise(start.size());
  auto const summary = integrate(net, Heat(), start, times, options, [&](Sample const& sample) {
    if (std::find(until.begin(), until.end(), sample.time) == until.end()) return;
    for (std::size_t i = 0; i < rise.size(); ++i) rise[i] = sample.temperatures[i] - room;
    file.write(reinterpret_cast<char const*>(rise.data()), std::streamsize(rise.size() * sizeof(double)));
  });
  std::printf(
      "{\"seconds\": %.6f, \"building\": %.6f, \"steps\": %ld, \"rates\": %ld, \"corrections\": %ld, "
      "\"jacobians\": %ld, \"failures\": %ld, \"peak_bytes\": %ld, \"imbalance\": %.1e, \"solver\": \"%s\"}\n",
      summary.wall_time, building.count(), summary.steps, summary.rate_evaluations, summary.nonlinear_iterations,
      summary.jacobian_evaluations, summary.error_test_failures, peak_memory(), summary.energy_imbalance(),
      std::string(name_of(summary.solver)).c_str());
  return 0;
}

}  // namespace
}  // namespace thermotwin::block

int main(int argc, char** argv) { return thermotwin::block::run(argc, argv); }
