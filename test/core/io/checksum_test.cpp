#include "io/checksum.h"

#include <gtest/gtest.h>

#include <string>

namespace uncertainty_identification {
namespace {

/// The check value of CRC-32/ISO-HDLC in the catalogue of parametrised CRC algorithms.
TEST(Checksum, IsTheStandardOne) {
  const std::string digits = "123456789";
  EXPECT_EQ(checksumOf(digits.data(), digits.size()), 0xCBF43926U);
  EXPECT_EQ(checksumOf(nullptr, 0), 0U);
}

}  // namespace
}  // namespace uncertainty_identification
