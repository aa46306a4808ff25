#pragma once

#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Tests of what cannot be predicted may pass though the simulation lacks much, even though a
/// constant would simulate better. Says so then, and withdraws noise and wrong readings as causes:
/// what the simulation lacks looks like them. Where the simulation lacks nothing, the message says
/// that such causes do not change it.
void warnOfPoorSimulation(Explanation* explanation);

/// What the model without causes takes the rest of the output for, to be added to its fit [%];
/// empty where little is left, or most. `none` means that the tests see nothing more that the input
/// causes; the output may hold other things.
std::string restInWords(double fit, bool plants_differ);

/// Whether several experiments leave such a rest, which may be that their plants differ: the model
/// of the search does not say by how much.
bool leavesDifferencesUntold(const Explanation& explanation);

/// Why a model without causes that passes its tests is not the answer, in a sentence: it simulates
/// few experiments poorly, which do not show whether they differ by chance. Empty where it is.
std::string tooFewToTell(std::size_t experiments, double fit);

/// Whether a model without causes that simulates with this fit [%] lacks what the linear plant of
/// the free simulation has. That one has one offset for all, so that nothing is said of a model
/// with several: its fit is about another mean. Nor where it oscillates for ever, along a line that
/// does not come from the input.
bool isBehindLinear(const Estimate& model, double fit, const SimulationCauses& simulation);

/// Whether nothing was looked for, since the data or the steps of the input are too few, in a model
/// that is not to be relied on: tests that pass say little then.
bool saysLittle(const Trust& trust, const SimulationCauses& simulation);

}  // namespace uncertainty_identification
