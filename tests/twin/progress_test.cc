#include "twin/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace thermotwin::twin {
namespace {

TEST(Progress, NobodyToTellIsNoReasonToStop) {
  int const before = ::dup(STDERR_FILENO), full = ::open("/dev/full", O_WRONLY);
  ::dup2(full, STDERR_FILENO);
  EXPECT_NO_THROW(tell("half of it is done\n"));
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  ::close(full);
}

}  // namespace
}  // namespace thermotwin::twin
