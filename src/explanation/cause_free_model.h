#pragma once

#include "explanation/search_progress.h"
#include "explanation/split.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// The search extends a model whose error is a finite impulse response, with one offset for all
/// experiments. Where plants differ in a parameter, or each experiment has an offset of its own, no
/// cause may be found in it although a linear plant describes all that was measured: the one that
/// identify chooses by default. Where the search ends with tests that fail and no curve that halves
/// the squared error of the simulation, that model is identified from `data.train`. If nothing
/// speaks against it, on the held-out experiments either, the verdict becomes `none`.
/// `asked` is the user's configuration; only one that leaves orders and error model to be chosen is
/// tried. Without time left, nothing is done.
void compareWithCauseFreeModel(const Configuration& asked, const Split& data,
                               SearchProgress& progress, Explanation* explanation);

}  // namespace uncertainty_identification
