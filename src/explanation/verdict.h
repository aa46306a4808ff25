#pragma once

#include "explanation/search.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// How the tests of the residuals end, and what the free simulation shows.
struct TestsAround {
  bool passed_before = false;       ///< all of them, without the causes
  bool passed = false;              ///< all of them, with the causes
  bool fail_of_noise_only = false;  ///< with the causes, those of the plant and of the colour pass
  std::vector<std::string> simulated =
      {};  ///< a curve found there that is not confirmed: its names
};

/// Why an accepted cause is described by the model and not named, as a sentence; empty where it is
/// named.
std::string reasonNotToName(const FoundCause& found, const SearchState& state,
                            const TestsAround& tests);

/// Whether a cause that acts on the simulation raises the likelihood by less than 100 nats and
/// leaves the simulation of held-out data as it is. Where all tests pass without it, it may be no
/// more than a better guess of the states that slow plants begin from.
bool isBesideSimulation(const FoundCause& found);

/// Whether a cause, while some check still fails, may be only a symptom of something that the
/// catalogue lacks. That is so for every cause of the noise and, unless only tests of the noise's
/// distribution fail and it is worth 100 nats, for hum, which resonances that the model lacks look
/// like, and for a cause whose score is exceeded by that of another cause outside the noise, or by
/// a third by that of a cause of the noise. Causes that the samples show by themselves are no
/// symptoms. reasonNotToName() names such a cause all the same where the free simulation found it.
bool isSymptom(const FoundCause& found, const SearchState& state, bool fail_of_noise_only);

/// Whether a cause changes every experiment, in a way that is neither of the noise nor of single
/// samples nor a higher order.
bool isInEveryExperiment(const FoundCause& found);

/// Where all tests pass without causes, but what was found and not named makes the data far more
/// likely, the tests are too weak: the verdict becomes `unknown`, not `none`.
void doubtAgreement(const SearchState& found, Explanation* explanation);

/// A check of the number of causes outside the noise. Several independent faults at once are
/// unlikely: three causes that describe the data together are more often one that the catalogue
/// lacks.
Check parsimony(const SearchState& state);

/// Adds that check to those without and with the causes, where the model with them fails it.
void addFailedParsimony(const SearchState& base, const SearchState& named,
                        Explanation* explanation);

/// The causes in words with their names in parentheses, as messages list them.
std::string describedNames(const std::vector<Cause>& causes);

/// Whether all that fails is a matter of the noise alone: how its residuals are distributed, and
/// when they are large. What the plant lacks shows in the dependence on the input.
bool isOfNoiseAlone(const std::vector<Check>& checks);

/// The names of the checks of the noise alone that fail, separated by commas.
std::string failedOfNoise(const std::vector<Check>& checks);

/// Sets verdict and message of an explanation from its causes and checks. `withheld`: causes were
/// found that are not named.
void conclude(Explanation* explanation, bool withheld = false);

/// Says first that not all experiments belong together, where the model tells so and nothing is
/// named as a cause: the verdict is then not `none`.
void tellOddExperiments(Explanation* explanation);

}  // namespace uncertainty_identification
