#pragma once

#include <string>

namespace uncertainty_identification {

/// Where in the simulation a curve acts:
///
///     u -> [input, input_hysteresis, rate_limit, play, dead time] -> (+) -> linear plant -> x ->
///     [sensor, output_play] -> y
///                                                   ^- position, rate, products, time, covariates
///
/// Curves of x, of its rate and of a loop's error are fed back to the plant's input. For a plant of
/// the first order, x may itself be a speed, so that "position" is a place in the model and not a
/// unit.
enum class Place {
  input,          ///< u + f(u)
  position,       ///< f(x), added to the plant's input: a restoring force, a loss
  rate,           ///< f(change of x from sample to sample), added to the plant's input: friction
  position_gain,  ///< the input acts by 1 + f(x)
  input_times_position,  ///< x f(u), added to the plant's input
  sensor,                ///< y + f(y)
  play,                  ///< backlash of the input, of unknown width
  rate_limit,            ///< of the input
  time_gain,             ///< the input acts by 1 + f(t)
  time,                  ///< f(t), added to the plant's input
  output_play,           ///< backlash of the output
  covariate,             ///< f(covariate), added to the plant's input
  covariate_gain,        ///< the input acts by 1 + f(covariate)
  rate_gain,             ///< the input acts by 1 + f(rate)
  output_state,          ///< f(x), added to the change of x itself; plants of the second order on
  loop_error,  ///< f(e), added to the plant's input, where e is the input less the one that would
               ///< hold x: a limit within a plant that is a control loop, as a servo is
  hysteresis,  ///< |u| f(x), added to the plant's input: a loop that does not depend on speed, as
               ///< of Dahl and of Bouc and Wen, where u is the velocity
  input_hysteresis  ///< u + the sum of c_i p_i, where p_i is u behind a play of some width (Prandtl
                    ///< and Ishlinskii): a magnetic or piezoelectric actuator, a sticking valve
};

/// What the place is called in results, such as "input" or "position".
std::string nameOf(Place place);

/// Whether the places are one: a force acts on the output's own state as it does on the position.
bool isSamePlace(Place left, Place right);

/// Whether the place holds a width, a limit or the weights of plays instead of a curve.
bool isScalar(Place place);

/// How much of {1, z} the linear plant already expresses at the place, so that a curve must not
/// contain it: 2 = constant and slope, 1 = constant.
int linearPart(Place place);

/// Whether the signal has a zero that means something: no voltage, no speed, no deflection.
bool hasPhysicalZero(Place place);

/// Whether the signal itself passes the place, so that what comes out is the signal and the curve.
bool isPassed(Place place);

/// Whether the curve is fed back, so that the plant's own poles may lie outside the unit circle.
bool isFedBack(Place place);

}  // namespace uncertainty_identification
