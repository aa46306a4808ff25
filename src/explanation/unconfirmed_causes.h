#pragma once

#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Drops causes with which tests fail, and that gain too little on held-out data. Those that a
/// simulation must show have to be clear there; of others, and where no simulation is useful, the
/// log density has to gain with 95 %. What changes the plant must not make its simulation worse
/// where tests of the plant still fail.
void dropUnconfirmed(Explanation* explanation);

/// Drops curves of the likelihood with which tests fail, where the simulation found another one and
/// withheld it: neither of the two is confirmed, and the likelihood's may only resemble it.
void dropBesideWithheld(Explanation* explanation);

/// Drops curves of the likelihood with which tests fail, and that the simulation does not show at
/// all: where something else is wrong, any curve takes part of it up. One that differs between
/// experiments is none that it could show.
void dropNotShown(Explanation* explanation);

}  // namespace uncertainty_identification
