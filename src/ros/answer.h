#pragma once

#include <cstdint>
#include <string>

#include "io/printable.h"
#include "session/refused_error.h"

namespace uncertainty_identification {

/// An answer with a code and a message; its other fields have their default values. Bytes of the
/// message that are no UTF-8, as names from requests may hold, are escaped.
template <typename Response>
Response answerOf(std::uint8_t code, const std::string& message) {
  Response response;
  response.code = code;
  response.message = printableText(message);
  return response;
}

/// Returns what `work` returns. If it throws, the answer has the code for the type of the
/// exception, and its message.
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
