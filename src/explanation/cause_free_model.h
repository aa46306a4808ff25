#pragma once

#include "explanation/search_outcome.h"
#include "explanation/search_progress.h"
#include "explanation/split.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// The search extends a model whose error is a finite impulse response, with one offset for all
/// experiments. Where plants differ in a parameter, or each experiment has an offset of its own, no
/// cause may be found in it although a linear plant describes all that was measured: the one that
/// identify chooses by default. Where the search ends with an answer that explains only a part,
/// with one of nothing but differences between experiments, or with none, that model is identified
/// from `data.train`. If its tests pass at the level of explain's and no cause simulates the
/// held-out experiments clearly better, nor makes the data far more likely (`with_causes`), causes
/// are withdrawn; the verdict becomes `none` if they pass at their own level and it explains most
/// of the output. `asked` is the user's configuration; only one that leaves orders and error model
/// to be chosen is tried. It may take half of explanation.time_limit in addition; a warning tells
/// if that is too short.
void compareWithCauseFreeModel(const Configuration& asked, const Split& data,
                               const AnswerLikelihood& with_causes, SearchProgress& progress,
                               Explanation* explanation);

}  // namespace uncertainty_identification
