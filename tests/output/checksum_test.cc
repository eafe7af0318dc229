#include "output/checksum.h"

#include <gtest/gtest.h>

namespace thermotwin::output {
namespace {

/// The check value that the catalogue of parametrised CRC algorithms gives for CRC-32/ISO-HDLC.
TEST(Checksum, OfTheNineDigits) {
  EXPECT_EQ(crc_32("123456789"), 0xCBF43926u);
  EXPECT_EQ(crc_32(""), 0u);
}

}  // namespace
}  // namespace thermotwin::output
