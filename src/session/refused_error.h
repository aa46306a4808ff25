#pragma once

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// A request that is not allowed, in contrast to one that was tried and failed.
class RefusedError : public Error {
 public:
  using Error::Error;
};

}  // namespace uncertainty_identification
