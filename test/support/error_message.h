#pragma once

#include <string>

namespace uncertainty_identification {

/// The message of the exception of this type that the action throws; what happened instead, if it
/// throws none.
template <typename Exception, typename Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("another exception: ") + error.what();
  }
  return "no exception";
}

}  // namespace uncertainty_identification
