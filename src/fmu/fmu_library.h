#pragma once

#include <map>
#include <string>
#include <string_view>

namespace uncertainty_identification {

/// The shared library of an FMU, loaded into this process.
class FmuLibrary {
 public:
  /// Throws FileError with the loader's reason.
  explicit FmuLibrary(const std::string& path);
  ~FmuLibrary();
  FmuLibrary(const FmuLibrary&) = delete;
  FmuLibrary& operator=(const FmuLibrary&) = delete;

  /// A function that it exports; `name` must be a literal. Throws FileError where there is none.
  template <class Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;

  std::string path_;
  void* handle_ = nullptr;
  mutable std::map<std::string_view, void*> found_;  ///< searching costs more than most functions
};

}  // namespace uncertainty_identification
