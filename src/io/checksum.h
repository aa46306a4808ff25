#pragma once

#include <cstddef>
#include <cstdint>

namespace uncertainty_identification {

/// CRC-32 of IEEE 802.3, which finds every single changed bit and every run of up to 32 of them.
std::uint32_t checksumOf(const void* bytes, std::size_t size);

}  // namespace uncertainty_identification
