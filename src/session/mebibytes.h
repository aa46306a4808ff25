#pragma once

#include <cstdint>

namespace uncertainty_identification {

/// Converts a limit given in MiB to bytes.
constexpr std::uint64_t mebibytes(int count) { return static_cast<std::uint64_t>(count) << 20U; }

}  // namespace uncertainty_identification
