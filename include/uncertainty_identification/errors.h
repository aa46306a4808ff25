#pragma once

#include <stdexcept>

namespace uncertainty_identification {

/// Root of everything this package throws on bad input. "Did not converge" is a value, never an
/// exception.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The data cannot support an answer. The message names the experiment, what was found and what to
/// record instead. The tools exit with 1.
class DataError : public Error {
 public:
  using Error::Error;
};

/// A configuration or request that cannot be carried out. The message names the key, the value
/// found and what is allowed. The tools exit with 2.
class ConfigurationError : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be read or written. The message names the file and the reason. The tools exit
/// with 2.
class FileError : public Error {
 public:
  using Error::Error;
};

/// Somebody asked for the end of what was being read. Only callers that pass such a wish meet it.
class CancelledError : public Error {
 public:
  using Error::Error;
};

}  // namespace uncertainty_identification
