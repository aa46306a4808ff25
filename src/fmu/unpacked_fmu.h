#pragma once

#include <string>

#include "fmu/model_description.h"

namespace uncertainty_identification {

/// Whether this build reads FMUs: libzip and tinyxml2 were found when it was configured.
bool readsFmus();

/// An FMU whose files are on the disk. It may be given as a folder, and then stays where it is;
/// otherwise its library and its resources are unpacked into a temporary folder, which the
/// destructor removes.
class UnpackedFmu {
 public:
  /// Throws ConfigurationError where this build reads none; FileError, naming the file, where it
  /// cannot be read, is no zip archive, has no modelDescription.xml or none that can be used, no
  /// library for this machine, or entries that would lie outside its folder.
  explicit UnpackedFmu(const std::string& path);
  ~UnpackedFmu();
  UnpackedFmu(const UnpackedFmu&) = delete;
  UnpackedFmu& operator=(const UnpackedFmu&) = delete;

  const std::string& folder() const { return folder_; }
  const ModelDescription& description() const { return description_; }
  /// Path of its library.
  const std::string& library() const { return library_; }

 private:
  void unpack(const std::string& path);
  void removeTemporary();
  std::string findLibrary() const;

  std::string folder_;
  bool is_temporary_ = false;
  ModelDescription description_;
  std::string library_;
};

}  // namespace uncertainty_identification
