#pragma once

#include <ros/node_handle.h>
#include <ros/service_callback_helper.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include "ros/message_decoder.h"

namespace uncertainty_identification {

/// Throws DataError when the bytes are fewer than the definition and the lengths in them say, or
/// more than `most`: roscpp makes room for what an array's length says before it looks.
template <typename Message>
void requireSound(SerialisedMessage bytes, std::size_t most) {
  namespace traits = ros::message_traits;
  static const MessageDefinition kDefinition(traits::datatype<Message>(),
                                             traits::definition<Message>());
  if (bytes.size > most)
    throw DataError("the request has " + std::to_string(bytes.size) + " bytes; at most " +
                    std::to_string(most) + " are read (limits.max_request_size)");
  requireComplete(kDefinition, bytes);
}

/// Looks through a request before it is read; answers a broken one with `code` and the reason.
template <typename Service>
class CheckedServiceHelper
    : public ros::ServiceCallbackHelperT<
          ros::ServiceSpec<typename Service::Request, typename Service::Response>> {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  using Base = ros::ServiceCallbackHelperT<ros::ServiceSpec<Request, Response>>;

  CheckedServiceHelper(const typename Base::Callback& answer, std::uint8_t code, std::size_t most)
      : Base(answer), code_(code), most_(most) {}

  bool call(ros::ServiceCallbackHelperCallParams& parameters) override {
    const ros::SerializedMessage& request = parameters.request;
    const auto header = static_cast<std::size_t>(request.message_start - request.buf.get());
    try {
      requireSound<Request>({request.message_start, request.num_bytes - header}, most_);
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
  std::size_t most_;  // [bytes] of a request
};

/// Advertises a service whose request has arrays; `code` answers requests that are broken
/// or have more than `most` bytes.
template <typename Service>
ros::ServiceServer advertiseChecked(
    ros::NodeHandle& node, const std::string& name,
    const boost::function<bool(typename Service::Request&, typename Service::Response&)>& answer,
    std::uint8_t code, std::size_t most) {
  ros::AdvertiseServiceOptions options;
  options.initBySpecType<ros::ServiceSpec<typename Service::Request, typename Service::Response>>(
      name, answer);
  options.helper = boost::make_shared<CheckedServiceHelper<Service>>(answer, code, most);
  return node.advertiseService(options);
}

}  // namespace uncertainty_identification
