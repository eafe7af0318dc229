#include <cstdio>

#include "twin/command_line.h"

int main(int argc, char** argv) {
#ifdef __AVX2__
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    std::fputs("error: built for processors with AVX2 and FMA; build with -DTHERMOTWIN_AVX2=OFF for this one\n",
               stderr);
    return 2;
  }
#endif
  return thermotwin::twin::command_line(argc, argv);
}
