#pragma once

#include <sys/mman.h>

#include <new>

namespace uncertainty_identification {

/// An object that a process shares with those it forks. It is never destroyed.
template <typename Value>
Value& sharedWithChildren() {
  void* memory =
      mmap(nullptr, sizeof(Value), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return *new (memory) Value();
}

}  // namespace uncertainty_identification
