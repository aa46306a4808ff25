#pragma once

#include <ros/node_handle.h>
#include <ros/service_callback_helper.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include "ros/message_decoder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// Checks a serialised request before it is deserialised: roscpp allocates as many elements as an
/// array's length says, even if the bytes do not contain them. Throws DataError when there are
/// fewer bytes than the definition and the lengths in them need, or more than `max_bytes`.
template <typename Message>
void requireSound(SerialisedMessage bytes, std::size_t max_bytes) {
  namespace traits = ros::message_traits;
  static const MessageDefinition kDefinition(traits::datatype<Message>(),
                                             traits::definition<Message>());
  if (bytes.size > max_bytes)
    throw DataError("the request has " + std::to_string(bytes.size) + " bytes; at most " +
                    std::to_string(max_bytes) + " are read (limits.max_request_size)");
  requireComplete(kDefinition, bytes);
}

/// Checks each request by requireSound() and answers a broken one with `code` and the reason.
template <typename Service>
class CheckedServiceHelper
    : public ros::ServiceCallbackHelperT<
          ros::ServiceSpec<typename Service::Request, typename Service::Response>> {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  using Base = ros::ServiceCallbackHelperT<ros::ServiceSpec<Request, Response>>;

  CheckedServiceHelper(const typename Base::Callback& answer, std::uint8_t code,
                       std::size_t max_bytes)
      : Base(answer), code_(code), max_bytes_(max_bytes) {}

  bool call(ros::ServiceCallbackHelperCallParams& parameters) override {
    const ros::SerializedMessage& request = parameters.request;
    const auto header = static_cast<std::size_t>(request.message_start - request.buf.get());
    try {
      requireSound<Request>({request.message_start, request.num_bytes - header}, max_bytes_);
      return Base::call(parameters);
    } catch (const std::exception& error) {
      Response response;
      response.code = code_;
      response.message = error.what();
      parameters.response = ros::serialization::serializeServiceResponse(true, response);
      return true;
    }
  }

 private:
  std::uint8_t code_;
  std::size_t max_bytes_;
};

/// Advertises a service whose requests contain arrays. Requests that are broken or have more than
/// `max_bytes` bytes are answered with `code`.
template <typename Service>
ros::ServiceServer advertiseChecked(
    ros::NodeHandle& node, const std::string& name,
    const boost::function<bool(typename Service::Request&, typename Service::Response&)>& answer,
    std::uint8_t code, std::size_t max_bytes) {
  ros::AdvertiseServiceOptions options;
  options.initBySpecType<ros::ServiceSpec<typename Service::Request, typename Service::Response>>(
      name, answer);
  options.helper = boost::make_shared<CheckedServiceHelper<Service>>(answer, code, max_bytes);
  return node.advertiseService(options);
}

}  // namespace uncertainty_identification
