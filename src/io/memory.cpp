#include "io/memory.h"

#include <malloc.h>

#include <limits>

namespace uncertainty_identification {

void keepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace uncertainty_identification
