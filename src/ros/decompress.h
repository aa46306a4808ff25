#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "ros/message_decoder.h"

namespace uncertainty_identification {

/// Decompresses a chunk of a bag. `compression` is "none", "bz2" or "lz4", `size` the number of
/// bytes of the result. Throws DataError when the data are damaged or `compression` or `size` is
/// wrong.
std::vector<std::uint8_t> decompress(std::string_view compression, SerialisedMessage data,
                                     std::uint32_t size);

}  // namespace uncertainty_identification
