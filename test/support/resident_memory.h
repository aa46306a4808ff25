#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace uncertainty_identification {

/// Memory of a process that is not swapped out [MB].
inline double residentMemory(pid_t process) {
  std::ifstream statm("/proc/" + std::to_string(process) + "/statm");
  long size = 0, resident = 0;
  statm >> size >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace uncertainty_identification
