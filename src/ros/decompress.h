#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "ros/message_decoder.h"

namespace uncertainty_identification {

/// The content of a chunk of a bag, compressed as "none", "bz2" or "lz4", `size` bytes long. Throws
/// DataError when the data are damaged, or of another compression or size.
std::vector<std::uint8_t> decompress(std::string_view compression, SerialisedMessage data,
                                     std::uint32_t size);

}  // namespace uncertainty_identification
