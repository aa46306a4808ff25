#pragma once

namespace uncertainty_identification {

/// Makes the allocator keep freed memory instead of returning it to the system. Each pass over the
/// data needs as much memory as the one before, and with long experiments half of the computing
/// time would go into requesting it anew. Acts on the whole process, so only programs call it.
void keepFreedMemory();

}  // namespace uncertainty_identification
