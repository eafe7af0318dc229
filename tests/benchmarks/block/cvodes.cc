// peer_cvodes NX NY NZ RTOL [FILE]: the block of course.h by CVODES as it comes: GMRES without a preconditioner, the
// right-hand side a stencil, serial vectors.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cvodes/cvodes.h>
#include <fstream>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include "tests/benchmarks/block/course.h"
#include "tests/benchmarks/block/peak_memory.h"

namespace thermotwin::block {
namespace {

struct Block {
  std::array<int, 3> n;
  std::array<double, 3> rate;   ///< of conduction along each direction [1/s]
  std::array<double, 3> outer;  ///< of a film on each direction's faces [1/s]
  std::vector<int> heated;
  double kelvin_per_second = 0.0;  ///< in each heated cell
};

Block make(std::array<int, 3> const& n) {
  Block block{n, {}, {}, heated_cells(n), 0.0};
  double volume = 1.0;
  for (std::size_t d = 0; d < 3; ++d) {
    double const step = size[d] / n[d];
    volume *= step;
    block.rate[d] = conductivity / (step * step) / (density * specific_heat);
    block.outer[d] = film / step / (density * specific_heat);
  }
  block.kelvin_per_second = 1.0 / double(block.heated.size()) / (density * specific_heat * volume);
  return block;
}

int rate(double, N_Vector y, N_Vector ydot, void* user) {
  auto const& block = *static_cast<Block const*>(user);
  double const* T = N_VGetArrayPointer(y);
  double* f = N_VGetArrayPointer(ydot);
  auto const [nx, ny, nz] = block.n;
  std::array<int, 3> const stride{1, nx, nx * ny};
  for (int k = 0, node = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i, ++node) {
        std::array<int, 3> const place{i, j, k};
        double sum = 0.0;
        for (std::size_t d = 0; d < 3; ++d) {
          sum += place[d] > 0 ? block.rate[d] * (T[node - stride[d]] - T[node]) : -block.outer[d] * T[node];
          sum +=
              place[d] + 1 < block.n[d] ? block.rate[d] * (T[node + stride[d]] - T[node]) : -block.outer[d] * T[node];
        }
        f[node] = sum;
      }
  for (int const cell : block.heated) f[cell] += block.kelvin_per_second;
  return 0;
}

int run(int argc, char** argv) {
  if (argc < 5) return std::puts("peer_cvodes NX NY NZ RTOL [FILE]"), 2;
  std::array<int, 3> const n{std::atoi(argv[1]), std::atoi(argv[2]), std::atoi(argv[3])};
  Block block = make(n);
  double const per_watt = block.kelvin_per_second, rtol = std::atof(argv[4]);
  sunindextype const count = n[0] * n[1] * n[2];
  std::ofstream file;
  if (argc > 5) file.open(argv[5], std::ios::binary);
  auto const begin = std::chrono::steady_clock::now();
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  N_Vector y = N_VNew_Serial(count, context);
  N_VConst(0.0, y);
  void* cvode = CVodeCreate(CV_BDF, context);
  CVodeInit(cvode, rate, 0.0, y);
  CVodeSetUserData(cvode, &block);
  CVodeSStolerances(cvode, 1e-14, 10.0 * rtol);
  SUNLinearSolver solver = SUNLinSol_SPGMR(y, SUN_PREC_NONE, 0, context);
  CVodeSetLinearSolver(cvode, solver, nullptr);
  CVodeSetMaxNumSteps(cvode, 10'000'000);
  double t = 0.0;
  long steps = 0;
  for (std::size_t piece = 0; piece < until.size(); ++piece) {
    block.kelvin_per_second = per_watt * watts[piece];
    CVodeReInit(cvode, t, y);
    CVodeSetStopTime(cvode, until[piece]);
    for (double out = t + output_interval; out <= until[piece]; out += output_interval)
      if (CVode(cvode, out, y, &t, CV_NORMAL) < 0) return 1;
    long taken = 0;
    CVodeGetNumSteps(cvode, &taken);
    steps += taken;
    file.write(reinterpret_cast<char const*>(N_VGetArrayPointer(y)),
               std::streamsize(std::size_t(count) * sizeof(double)));
  }
  std::chrono::duration<double> const taken = std::chrono::steady_clock::now() - begin;
  std::printf("{\"seconds\": %.6f, \"steps\": %ld, \"peak_bytes\": %ld}\n", taken.count(), steps, peak_memory());
  CVodeFree(&cvode);
  SUNLinSolFree(solver);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return 0;
}

}  // namespace
}  // namespace thermotwin::block

int main(int argc, char** argv) { return thermotwin::block::run(argc, argv); }
