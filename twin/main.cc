#include <climits>
#include <cstdio>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "twin/command_line.h"

int main(int argc, char** argv) {
#ifdef __AVX2__
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    std::fputs("error: built for processors with AVX2 and FMA; build with -DTHERMOTWIN_AVX2=OFF for this one\n",
               stderr);
    return 2;
  }
#endif
#ifdef __GLIBC__
  // Matrices come and go by the megabyte; what is given back, the kernel clears before it lends it again.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
#endif
  return thermotwin::twin::command_line(argc, argv);
}
