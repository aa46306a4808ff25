#include "fmu/fmu_library.h"

#include <dlfcn.h>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

FmuLibrary::FmuLibrary(const std::string& path) : path_(path) {
  handle_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle_) throw FileError(std::string("the FMU's library cannot be loaded: ") + dlerror());
}

FmuLibrary::~FmuLibrary() {
  if (handle_) dlclose(handle_);
}

void* FmuLibrary::symbol(const char* name) const {
  void*& found = found_[name];
  if (!found) found = dlsym(handle_, name);
  if (!found) throw FileError(path_ + ": the FMU's library lacks the function " + name);
  return found;
}

}  // namespace uncertainty_identification
