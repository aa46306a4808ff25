#pragma once

namespace uncertainty_identification {

constexpr double kPi = 3.14159265358979323846;

}  // namespace uncertainty_identification
