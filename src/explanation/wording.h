#pragma once

#include <string>

#include "uncertainty_identification/effects/effect.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Effects and orders in the words of messages.
namespace uncertainty_identification {

/// An effect as a message names it, e.g. "dead zone of the actuator (act_deadzone)".
std::string named(const Effect& effect);

/// The group of an effect, e.g. "actuator" for "act_deadzone".
std::string groupOf(const std::string& name);

/// The orders of the nominal model, e.g. "nb=1 na=1 nc=1 nd=1 delay=0".
std::string orderText(const Estimate& estimate);

}  // namespace uncertainty_identification
