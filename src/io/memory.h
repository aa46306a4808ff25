#pragma once

namespace uncertainty_identification {

/// Tells the allocator to keep freed memory for the next sweep instead of handing it back to the
/// system page by page: with long experiments that is half the time otherwise. Acts on the whole
/// process, so programs call it, never the libraries.
void keepFreedMemory();

}  // namespace uncertainty_identification
