#include "io/checksum.h"

#include <boost/crc.hpp>

namespace uncertainty_identification {

std::uint32_t checksumOf(const void* bytes, std::size_t size) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes, size);
  return crc.checksum();
}

}  // namespace uncertainty_identification
