#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ros/bag_name.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/loaded_data.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

/// What requests to identify and to explain have in common.
namespace uncertainty_identification {

/// The configuration of a request: YAML text, or the node's own where that is empty. Throws
/// ConfigurationError.
Configuration requestedConfiguration(const std::string& yaml, const Configuration& own);

/// What the bags of these names below `directory` hold, none for no names. `progress` is called in
/// the phase "reading bags"; false from it cancels. Throws RefusedError, FileError, CancelledError.
LoadedData loadRequestedBags(const std::vector<std::string>& names, const std::string& directory,
                             const Configuration& configuration, const ProgressCallback& progress);

/// An answer of this type with its code and message alone.
template <typename Response>
Response answerOf(std::uint8_t code, const std::string& message) {
  Response response;
  response.code = code;
  response.message = message;
  return response;
}

/// What `work` gives; what it throws as a code of the answer and a message instead.
template <typename Response, typename Work>
Response answerErrors(const Work& work) {
  try {
    return work();
  } catch (const RefusedError& error) {
    return answerOf<Response>(Response::REFUSED, error.what());
  } catch (const ConfigurationError& error) {
    return answerOf<Response>(Response::CONFIGURATION_ERROR, error.what());
  } catch (const DataError& error) {
    return answerOf<Response>(Response::DATA_ERROR, error.what());
  } catch (const FileError& error) {
    return answerOf<Response>(Response::FILE_ERROR, error.what());
  } catch (const CancelledError& error) {
    return answerOf<Response>(Response::CANCELLED, error.what());
  } catch (const std::exception& error) {
    return answerOf<Response>(Response::INTERNAL_ERROR,
                              std::string("internal error: ") + error.what());
  }
}

}  // namespace uncertainty_identification
