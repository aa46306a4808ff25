#pragma once

#include <stdexcept>

namespace uncertainty_identification {

/// Base class of everything that this package throws on bad input. Not converging is no exception:
/// the result reports it (Estimate::termination).
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The data do not allow an answer. The message names the experiment, what was found and what to
/// record instead. The tools exit with 1.
class DataError : public Error {
 public:
  using Error::Error;
};

/// A configuration or request that is not valid or cannot be carried out. The message names the
/// key, the value found and what is allowed. The tools exit with 2.
class ConfigurationError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be read or written. The message names the file and the reason. The tools exit with
/// 2.
class FileError : public Error {
 public:
  using Error::Error;
};

/// The work was cancelled. Thrown only where the caller passed a function that can cancel.
class CancelledError : public Error {
 public:
  using Error::Error;
};

}  // namespace uncertainty_identification
